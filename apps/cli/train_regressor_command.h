#pragma once
// `faceprobe train gardner` and `faceprobe train legendre`.

#include "faceprobe/train/train.h"

#include <string>

namespace faceprobe::cli {

// Folders and threads of `options` are used; `config`: the config's text, empty = the defaults.
int train_gardner(const train::TrainRun& options, const std::string& config);
int train_legendre(const train::TrainRun& options, const std::string& config);

}  // namespace faceprobe::cli

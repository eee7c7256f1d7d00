#pragma once
// `faceprobe train light`.

#include "faceprobe/train/train.h"

#include <string>

namespace faceprobe::cli {

// Folders and threads of `options` are used; `config`: the config's text, empty = the defaults.
int train_light(const train::TrainRun& options, const std::string& config);

}  // namespace faceprobe::cli

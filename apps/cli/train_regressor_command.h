#pragma once
// `faceprobe train gardner` and `faceprobe train legendre`.

#include "faceprobe/train/train.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

// Folders and threads of `options` are used; `config`: the config's text, empty = the defaults. `scenes`: tables that say which maps are indoor
// (scene_table.h); none: all are taken.
int train_gardner(const train::TrainRun& options, const std::string& config, const std::vector<std::string>& scenes);
int train_legendre(const train::TrainRun& options, const std::string& config);

}  // namespace faceprobe::cli

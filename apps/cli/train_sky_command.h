#pragma once
// `faceprobe train sky`.

#include "faceprobe/train/train.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

// Folders, of maps, and threads of `options` are used; `config`: the config's text, empty = the defaults. `scenes`: tables that say which maps are
// outdoor and not of the night (scene_table.h); none: all are.
int train_sky(const train::TrainRun& options, const std::string& config, const std::vector<std::string>& scenes);

}  // namespace faceprobe::cli

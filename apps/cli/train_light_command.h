#pragma once
// `faceprobe train light`.

#include "faceprobe/train/train.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

// Folders and threads of `options` are used; `more`: further folders of data; `config`: the config's text, empty = the defaults.
int train_light(const train::TrainRun& options, const std::vector<std::string>& more, const std::string& config);

}  // namespace faceprobe::cli

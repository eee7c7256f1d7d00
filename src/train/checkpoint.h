#pragma once
// Internal: all that a run needs to go on as if it had not been stopped: the step, the weights with their mean, the optimiser's moments, and
// tables of what was logged.
//
//   Checkpoint state{.tables = {{"rows", table_of<13>({})}}};        // which tables there are, and how wide
//   if (load_checkpoint(path, state, descent, run_json)) ...
//   save_checkpoint(path, state, descent, run_json);

#include "train/descent.h"

#include <torch/torch.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace faceprobe::train {

struct Checkpoint {
  std::int64_t step = 0;
  std::map<std::string, torch::Tensor> tables = {};  // train/table.h
};

// `run_json`: what the run depends on. Appears whole or not at all. Throws Error(kOutput).
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& state, Descent& descent,
                     const std::string& run_json);
// False when there is none; of `state` the names and widths of the tables are read. Throws Error(kOutput) when it is of another run,
// Error(kInput) when it is damaged.
bool load_checkpoint(const std::filesystem::path& path, Checkpoint& state, Descent& descent,
                     const std::string& run_json);

}  // namespace faceprobe::train

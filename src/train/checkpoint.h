#pragma once
// Internal: all that a run needs to go on as if it had not been stopped.

#include "faceprobe/train/train.h"

#include <torch/torch.h>
#include <filesystem>

namespace faceprobe::train {

// Batch normalisation measures the layers below it in buffers, which fit the weights that they were measured with. Other buffers are constants.
enum class Averaged { kParameters, kParametersAndBuffers };

// Running mean of a module's parameters, which is smoother than they are (Polyak & Juditsky 1992).
class WeightAverage {
 public:
  WeightAverage(const torch::nn::Module& module, double decay, Averaged which = Averaged::kParameters);
  // Early on the mean follows faster, so that it is not of the first guess.
  void add(const torch::nn::Module& module, std::int64_t step);
  // What is averaged of the module changes places with the mean.
  void swap(torch::nn::Module& module);

  std::vector<torch::Tensor>& values() { return values_; }

 private:
  double decay_;
  Averaged which_;
  std::vector<torch::Tensor> values_;
};

struct Checkpoint {
  std::int64_t step = 0;
  std::vector<TrainRow> rows;
};

// Appears whole or not at all. Throws Error(kOutput).
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& state, torch::nn::Module& module,
                     torch::optim::AdamW& optimizer, WeightAverage& average, const std::string& run_json);
// False when there is none. Throws Error(kOutput) when it is of another run, Error(kInput) when it is damaged.
bool load_checkpoint(const std::filesystem::path& path, Checkpoint& state, torch::nn::Module& module,
                     torch::optim::AdamW& optimizer, WeightAverage& average, const std::string& run_json);

}  // namespace faceprobe::train

#pragma once
// Internal: what every step of a training does around its own loss: the learning rate and the dropout of that step, gradients kept within
// their limit, AdamW, and the running mean of the weights. All of it depends on the seed and the step alone.
//
//   Descent descent(model.module, {.schedule = {.peak = 1e-3, .steps = 100}});
//   descent.begin(step);
//   loss.backward();
//   descent.end(step, loss.item<double>());

#include "train/schedule.h"
#include "train/weight_average.h"

#include <torch/torch.h>
#include <cstdint>
#include <memory>

namespace faceprobe::train {

struct DescentOptions {
  Schedule schedule;
  double weight_decay = 0;
  double largest_gradient = 1;  // norm over all weights
  double average_decay = 0;     // 0 = the mean is the weights as they are
  Averaged averaged = Averaged::kParameters;
  std::uint64_t seed = 1;
};

class Descent {
 public:
  // The module is where it is to be trained, with the weights to begin with.
  Descent(std::shared_ptr<torch::nn::Module> module, const DescentOptions& options);

  void begin(std::int64_t step);
  // `loss`: of this step, whose gradients are there. Throws Error(kUnexpected) when it or they are no numbers; the weights are unchanged then.
  void end(std::int64_t step, double loss);

  torch::nn::Module& module() { return *module_; }
  torch::optim::AdamW& optimizer() { return optimizer_; }
  WeightAverage& average() { return average_; }

 private:
  std::shared_ptr<torch::nn::Module> module_;
  DescentOptions options_;
  WeightAverage average_;
  torch::optim::AdamW optimizer_;
};

}  // namespace faceprobe::train

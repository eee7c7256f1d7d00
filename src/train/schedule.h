#pragma once

#include "faceprobe/core/angles.h"
#include "faceprobe/train/config.h"

#include <torch/torch.h>
#include <algorithm>
#include <cmath>

namespace faceprobe::train {

// From 1 along half a cosine to final_share; done: 0 to 1.
inline double half_cosine(double done, double final_share) {
  return final_share + (1.0 - final_share) * 0.5 * (1.0 + std::cos(kPi * done));
}

// Rises in a line over the warm-up, then falls along half a cosine to final_share of the peak at the last step.
inline double learning_rate_at(const TrainConfig& config, std::int64_t step) {
  if (step < config.warm_up) {
    return config.learning_rate * static_cast<double>(step + 1) / static_cast<double>(config.warm_up);
  }
  const auto rest = static_cast<double>(std::max<std::int64_t>(1, config.steps - config.warm_up));
  const double done = std::min(1.0, static_cast<double>(step - config.warm_up) / rest);
  return config.learning_rate * half_cosine(done, config.final_share);
}

// The same for all weights: libtorch keeps one for each group of them.
inline void set_learning_rate(torch::optim::Optimizer& optimizer, double rate) {
  for (torch::optim::OptimizerParamGroup& group : optimizer.param_groups()) group.options().set_lr(rate);
}

}  // namespace faceprobe::train

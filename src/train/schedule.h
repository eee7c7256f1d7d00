#pragma once

#include "faceprobe/core/angles.h"

#include <torch/torch.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace faceprobe::train {

// From 1 along half a cosine to final_share; done: 0 to 1.
inline double half_cosine(double done, double final_share) {
  return final_share + (1.0 - final_share) * 0.5 * (1.0 + std::cos(kPi * done));
}

// A learning rate over the steps of a run: up in a line over the warm-up, then along half a cosine to final_share of the peak at the last
// step. What a constant rate leaves in the weights is noise.
struct Schedule {
  double peak = 1e-3;
  std::int64_t steps = 1;
  std::int64_t warm_up = 0;
  double final_share = 0.01;
};

inline double learning_rate_at(const Schedule& schedule, std::int64_t step) {
  if (step < schedule.warm_up)
    return schedule.peak * static_cast<double>(step + 1) / static_cast<double>(schedule.warm_up);
  const auto rest = static_cast<double>(std::max<std::int64_t>(1, schedule.steps - schedule.warm_up));
  const double done = std::min(1.0, static_cast<double>(step - schedule.warm_up) / rest);
  return schedule.peak * half_cosine(done, schedule.final_share);
}

// The same for all weights: libtorch keeps one for each group of them.
inline void set_learning_rate(torch::optim::Optimizer& optimizer, double rate) {
  for (torch::optim::OptimizerParamGroup& group : optimizer.param_groups()) group.options().set_lr(rate);
}

}  // namespace faceprobe::train

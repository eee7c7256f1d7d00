#pragma once

#include "faceprobe/train/config.h"

#include <cmath>

namespace faceprobe::train {

// Rises in a line over the warm-up, then falls along half a cosine to final_share of the peak at the last step.
inline double learning_rate_at(const TrainConfig& config, std::int64_t step) {
  if (step < config.warm_up) {
    return config.learning_rate * static_cast<double>(step + 1) / static_cast<double>(config.warm_up);
  }
  const auto rest = static_cast<double>(std::max<std::int64_t>(1, config.steps - config.warm_up));
  const double done = std::min(1.0, static_cast<double>(step - config.warm_up) / rest);
  const double share = config.final_share + (1.0 - config.final_share) * 0.5 * (1.0 + std::cos(3.14159265358979 * done));
  return config.learning_rate * share;
}

}  // namespace faceprobe::train

#include "train/descent.h"

#include "faceprobe/core/error.h"

#include <cmath>
#include <string>
#include <utility>

namespace faceprobe::train {

Descent::Descent(std::shared_ptr<torch::nn::Module> module, const DescentOptions& options)
    : module_(std::move(module)), options_(options), average_(*module_, options.average_decay, options.averaged),
      optimizer_(
          module_->parameters(),
          torch::optim::AdamWOptions(options.schedule.peak).betas({0.9, 0.99}).weight_decay(options.weight_decay)) {}

void Descent::begin(std::int64_t step) {
  // Dropout depends on the seed and the step alone, so that a resumed run drops the same.
  torch::manual_seed(options_.seed ^ (static_cast<std::uint64_t>(step) << 20U));
  set_learning_rate(optimizer_, learning_rate_at(options_.schedule, step));
  optimizer_.zero_grad();
}

void Descent::end(std::int64_t step, double loss) {
  const double norm = torch::nn::utils::clip_grad_norm_(module_->parameters(), options_.largest_gradient);
  if (!std::isfinite(loss) || !std::isfinite(norm)) {
    throw Error(ExitCode::kUnexpected, "The loss is no number any more after step " + std::to_string(step) +
                                           "; lower the learning rate. The last checkpoint is from before that.");
  }
  optimizer_.step();
  average_.add(*module_, step);
}

}  // namespace faceprobe::train

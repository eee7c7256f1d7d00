#include "train/loss.h"

namespace faceprobe::train {
namespace {

constexpr double kCorner =
    1e-3;  // below, the absolute error is rounded off: an eighth of a code value in the middle of the range
constexpr double kRootFloor = 1e-3;  // keeps the slope of the square root finite

torch::Tensor smooth_abs(const torch::Tensor& x) { return (x.square() + kCorner * kCorner).sqrt() - kCorner; }

torch::Tensor weighted_mean(const torch::Tensor& error, const torch::Tensor& weight) {
  return (error * weight).sum() / (weight.sum() * static_cast<double>(error.size(1)) + 1e-6);
}

}  // namespace

torch::Tensor highlight_loss(const torch::Tensor& highlight, const Batch& batch, const LossConfig& config) {
  const torch::Tensor weight = config.elsewhere + (1.0 - config.elsewhere) * batch.skin;
  const torch::Tensor error = highlight - batch.highlight;
  torch::Tensor loss = weighted_mean(smooth_abs(error), weight);
  if (config.encoded > 0) {
    const torch::Tensor roots = (highlight + kRootFloor).sqrt() - (batch.highlight + kRootFloor).sqrt();
    loss = loss + config.encoded * weighted_mean(smooth_abs(roots), weight);
  }
  if (config.gradient > 0) {
    for (const int axis : {2, 3}) {
      const std::int64_t last = error.size(axis) - 1;
      const torch::Tensor step = error.narrow(axis, 1, last) - error.narrow(axis, 0, last);
      loss = loss + config.gradient * weighted_mean(smooth_abs(step), weight.narrow(axis, 1, last));
    }
  }
  return loss;
}

torch::Tensor squared_loss(const torch::Tensor& highlight, const Batch& batch) {
  return (highlight - batch.highlight).square().mean();
}

}  // namespace faceprobe::train

#include "train/loss.h"

#include "train/smooth_error.h"

#include <vector>

namespace faceprobe::train {
namespace {

constexpr double kRootFloor = 1e-3;  // keeps the slope of the square root finite

// Root mean square of each picture's error where the weight is, then the mean over pictures.
torch::Tensor picture_rms(const torch::Tensor& error, const torch::Tensor& weight) {
  const torch::Tensor sum = (error.square() * weight).sum({1, 2, 3});
  const torch::Tensor count = static_cast<double>(error.size(1)) * weight.sum({1, 2, 3});
  return (sum / count.clamp_min(1) + kCorner * kCorner).sqrt().mean();
}

constexpr std::int64_t kWindow = 7;

// n x n: the mean over a window about each of n values, beyond whose ends there are zeros.
torch::Tensor window_matrix(std::int64_t n, const torch::TensorOptions& options) {
  return torch::ones({n, n}, options).triu(-(kWindow / 2)).tril(kWindow / 2) / kWindow;
}

// Mean over a square window about each pixel. Products with two matrices, because libtorch's pooling is slow on a processor.
torch::Tensor window_mean(const torch::Tensor& planes) {
  const torch::Tensor rows = torch::matmul(planes, window_matrix(planes.size(3), planes.options()));
  return torch::matmul(window_matrix(planes.size(2), planes.options()), rows);
}

// Structural similarity (eval/image_metrics.h) of the mean of the channels, with a square window in the Gaussian's place.
torch::Tensor similarity(const torch::Tensor& estimate, const torch::Tensor& truth, const torch::Tensor& mask) {
  constexpr double kC1 = 0.01 * 0.01;
  constexpr double kC2 = 0.03 * 0.03;
  const torch::Tensor x = estimate.mean(1, true) * mask;
  const torch::Tensor y = truth.mean(1, true) * mask;
  const std::vector<torch::Tensor> means = window_mean(torch::cat({x, y, x * x, y * y, x * y}, 1)).split(1, 1);
  const torch::Tensor& mx = means[0];
  const torch::Tensor& my = means[1];
  const torch::Tensor spread = means[2] + means[3] - mx * mx - my * my;
  const torch::Tensor shared = means[4] - mx * my;
  const torch::Tensor map = (2 * mx * my + kC1) * (2 * shared + kC2) / ((mx * mx + my * my + kC1) * (spread + kC2));
  return weighted_mean(map, mask);
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
  if (config.rms > 0) loss = loss + config.rms * picture_rms(error, batch.skin);
  if (config.similarity > 0) loss = loss + config.similarity * (1 - similarity(highlight, batch.highlight, batch.skin));
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

#include "train/shi_loss.h"

#include "train/layer_truth.h"
#include "train/loss.h"

namespace faceprobe::train {
namespace {

torch::Tensor square_where(const torch::Tensor& error, const torch::Tensor& known) {
  const double channels = static_cast<double>(error.size(1));
  return (error.square() * known).sum() / (channels * known.sum()).clamp_min(1);
}

torch::Tensor mostly_scale_invariant(const torch::Tensor& estimate, const torch::Tensor& truth,
                                     const torch::Tensor& known) {
  constexpr double kOfScale = 0.05;
  return (1 - kOfScale) * scale_invariant_error(estimate, truth, known) +
         kOfScale * square_where(estimate - truth, known);
}

}  // namespace

torch::Tensor scale_invariant_error(const torch::Tensor& estimate, const torch::Tensor& truth,
                                    const torch::Tensor& known) {
  constexpr double kLeast = 0.1, kMost = 10;
  // The best scale does not pull at the estimate: at a least square, and at a limit, its own slope is nothing.
  const torch::Tensor fixed = estimate.detach() * known;
  const torch::Tensor power = fixed.square().sum({2, 3}, true);
  const torch::Tensor best = (fixed * truth).sum({2, 3}, true) / power.clamp_min(1e-20);
  const torch::Tensor scale = torch::where(power > 0, best, torch::ones_like(best)).clamp(kLeast, kMost);
  return square_where(scale * estimate - truth, known);
}

torch::Tensor shi_loss(const net::ShiLayers& found, const Batch& batch) {
  const LayerTruth truth = layer_truth(batch);
  return mostly_scale_invariant(found.albedo, truth.albedo, truth.known) +
         mostly_scale_invariant(found.shading, truth.shading, truth.known) + squared_loss(found.highlight, batch);
}

}  // namespace faceprobe::train

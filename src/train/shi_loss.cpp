#include "train/shi_loss.h"

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

ShiTruth shi_truth(const Batch& batch) {
  constexpr double kDark = 1e-3;
  const torch::Tensor& shading = batch.surface.shading;
  const torch::Tensor lit = shading.amin(1, true) > kDark;
  const torch::Tensor known = lit.logical_and(batch.clip.amax(1, true) == 0).to(shading.scalar_type());
  // Noise and tone curve of the camera make more than 1 of the quotient here and there in the dark, up to a hundred.
  const torch::Tensor albedo = ((batch.linear - batch.highlight) / shading.clamp_min(kDark)).clamp(0, 1);
  return {albedo, shading, known};
}

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
  const ShiTruth truth = shi_truth(batch);
  return mostly_scale_invariant(found.albedo, truth.albedo, truth.known) +
         mostly_scale_invariant(found.shading, truth.shading, truth.known) + squared_loss(found.highlight, batch);
}

}  // namespace faceprobe::train

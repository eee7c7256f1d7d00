#include "train/face_loss.h"

#include "faceprobe/core/region.h"
#include "net/face_outputs.h"
#include "train/smooth_error.h"

#include <cmath>

namespace faceprobe::train {
namespace {

torch::Tensor unit(const torch::Tensor& x) { return x / x.square().sum(1, true).clamp_min(1e-8).sqrt(); }

// Of each picture.
torch::Tensor picture_mean(const torch::Tensor& values, const torch::Tensor& weight) {
  return (values * weight).sum({1, 2, 3}, true) / (weight.sum({1, 2, 3}, true) + 1e-6);
}

// The stated error as the scale of a two-dimensional Laplace distribution, density exp(-r / b) / (2 pi b^2), whose mean radius is 2 b:
// the least of r / b + 2 log b is where 2 b is the error to be expected. It does not pull at the normals, or the network would give up
// where it is unsure.
torch::Tensor spread_loss(const torch::Tensor& error, const net::FaceSurface& found, const torch::Tensor& weight) {
  const torch::Tensor scale = found.spread / 2;
  return weighted_mean(error.detach() / scale + 2 * scale.log(), weight);
}

torch::Tensor depth_loss(const torch::Tensor& depth, const SurfaceBatch& truth) {
  const torch::Tensor error = depth - truth.depth_m / net::FaceOutputs::kDepthUnit;
  return weighted_mean(smooth_abs(error - picture_mean(error, truth.weight)), truth.weight);
}

// Mostly of the shading's course over the face, a third of its level, which is the exposure over the skin's unknown albedo.
torch::Tensor shading_loss(const torch::Tensor& log_level, const torch::Tensor& shading, const torch::Tensor& known) {
  constexpr double kOfLevel = 0.3;
  const torch::Tensor error = (log_level - shading.mean(1, true).clamp_min(1e-4).log()) * known;
  const torch::Tensor level = picture_mean(error, known);
  return weighted_mean(smooth_abs(error - level), known) + kOfLevel * smooth_abs(level).mean();
}

// Of the shading without anything in the light's way. A side of the face that looks away from all light is as good as black below a hundredth.
torch::Tensor open_loss(const net::FaceSurface& found, const SurfaceBatch& truth) {
  constexpr double kDark = 1e-2;
  const torch::Tensor known = (truth.open.amax(1, true) > 0).to(torch::kFloat);
  const torch::Tensor light = truth.open.clamp_min(kDark);
  return shading_loss(found.open_log_level, light, known) + weighted_mean(chord(found.open_colour, light), known);
}

// Small regions are few pixels and would be given up.
torch::Tensor region_weights(double rare, const torch::TensorOptions& options) {
  torch::Tensor weights = torch::ones({kRegionCount}, options);
  const auto set = [&](Region region, double weight) { weights[static_cast<std::int64_t>(region)] = weight; };
  for (const Region region : {Region::kMouth, Region::kGlasses, Region::kObject}) set(region, rare);
  for (const Region region : {Region::kEyes, Region::kLips, Region::kBrows}) set(region, std::sqrt(rare));
  return weights;
}

}  // namespace

torch::Tensor chord(const torch::Tensor& a, const torch::Tensor& b) {
  const torch::Tensor difference = unit(a) - unit(b);
  return (difference.square().sum(1, true) + kCorner * kCorner).sqrt() - kCorner;
}

torch::Tensor surface_loss(const net::FaceSurface& found, const SurfaceBatch& truth, const LossConfig& config) {
  const torch::Tensor error = chord(found.normal, truth.normal);
  const torch::Tensor names = truth.region.squeeze(1).to(torch::kLong);
  const torch::Tensor weights = region_weights(config.rare, found.region.options());
  const torch::Tensor of_open =
      found.open_log_level.defined() ? config.open * open_loss(found, truth) : torch::zeros({}, error.options());
  return of_open + config.normal * weighted_mean(error, truth.weight) +
         config.spread * spread_loss(error, found, truth.weight) + config.depth * depth_loss(found.depth, truth) +
         config.region * torch::cross_entropy_loss(found.region, names, weights) +
         config.shading * shading_loss(found.log_level, truth.shading, truth.lit) +
         config.colour * weighted_mean(chord(found.colour, truth.shading), truth.lit);
}

}  // namespace faceprobe::train

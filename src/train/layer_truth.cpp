#include "train/layer_truth.h"

namespace faceprobe::train {

LayerTruth layer_truth(const Batch& batch) {
  constexpr double kDark = 1e-3;
  const torch::Tensor& shading = batch.surface.shading;
  const torch::Tensor lit = shading.amin(1, true) > kDark;
  const torch::Tensor known = lit.logical_and(batch.clip.amax(1, true) == 0).to(shading.scalar_type());
  // Noise and tone curve of the camera make more than 1 of the quotient here and there in the dark, up to a hundred.
  const torch::Tensor albedo = ((batch.linear - batch.highlight) / shading.clamp_min(kDark)).clamp(0, 1);
  return {albedo, shading, known};
}

}  // namespace faceprobe::train

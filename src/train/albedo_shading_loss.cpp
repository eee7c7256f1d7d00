#include "train/albedo_shading_loss.h"

#include "train/layer_truth.h"

namespace faceprobe::train {

torch::Tensor scale_invariant_loss(const torch::Tensor& found, const torch::Tensor& truth, const torch::Tensor& known,
                                   double lambda) {
  const torch::Tensor difference = (found - truth) * known;
  const torch::Tensor count = (static_cast<double>(found.size(1)) * known.sum({1, 2, 3})).clamp_min(1);
  const torch::Tensor square = difference.square().sum({1, 2, 3}) / count;
  const torch::Tensor level = difference.sum({1, 2, 3}) / count;
  return (square - lambda * level.square()).mean();
}

torch::Tensor albedo_shading_loss(const net::LogLayers& found, const Batch& batch,
                                  const net::AlbedoShadingOptions& options) {
  const LayerTruth truth = layer_truth(batch);
  const auto of = [&](const torch::Tensor& log, const torch::Tensor& light) {
    return scale_invariant_loss(log, net::log_of_light(light, options), truth.known, kReleasedLambda);
  };
  return of(found.albedo, truth.albedo) + of(found.shading, truth.shading);
}

}  // namespace faceprobe::train

#pragma once
// Internal: what the paper's Albedo-Shading network (net/torch/albedo_shading.h) is trained on: that of Narihira et al. 2015, as released.

#include "net/torch/albedo_shading.h"
#include "train/batch.h"

#include <torch/torch.h>

namespace faceprobe::train {

// Of both layers: the level is free altogether.
inline constexpr double kReleasedLambda = 1;

// sum d^2 / n - lambda (sum d)^2 / n^2 with d = found - truth over the n values of a picture where `known` (N x 1 x H x W of 0 and 1), which are
// of all channels together; the mean over pictures. A picture of which nothing is known counts as 0. lambda 1: the variance of d; 0: its mean square.
torch::Tensor scale_invariant_loss(const torch::Tensor& found, const torch::Tensor& truth, const torch::Tensor& known,
                                   double lambda);

// A scalar with a gradient: that of the logarithms of albedo and of shading, one as much as the other. `batch.surface` must be there.
torch::Tensor albedo_shading_loss(const net::LogLayers& found, const Batch& batch,
                                  const net::AlbedoShadingOptions& options);

}  // namespace faceprobe::train

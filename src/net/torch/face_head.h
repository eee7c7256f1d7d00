#pragma once
// The face network's raw output as surface and light, for training. See net/face_outputs.h.

#include <torch/torch.h>

namespace faceprobe::net {

// N pictures of H x W, single precision.
struct FaceSurface {
  torch::Tensor normal;    // N x 3, unit, camera frame
  torch::Tensor spread;    // N x 1, expected error of the normal, radians, > 0
  torch::Tensor depth;     // N x 1, in FaceOutputs::kDepthUnit, from an origin of its own
  torch::Tensor log_level;  // N x 1, logarithm of the mean over channels of the shading
  torch::Tensor colour;    // N x 3, of the shading; mean over channels 1, > 0
  torch::Tensor region;    // N x kRegionCount, scores before the softmax
};

// `raw`: N x FaceOutputs::kCount x H x W. Throws std::invalid_argument for another number of channels.
FaceSurface surface_from_raw(const torch::Tensor& raw);

}  // namespace faceprobe::net

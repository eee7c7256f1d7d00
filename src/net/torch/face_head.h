#pragma once
// The face network's input, and its raw output as surface and light, for training. See net/face_outputs.h.

#include <torch/torch.h>

namespace faceprobe::net {

// N pictures of H x W, single precision.
struct FaceSurface {
  torch::Tensor normal;     // N x 3, unit, camera frame
  torch::Tensor spread;     // N x 1, expected error of the normal, radians, > 0
  torch::Tensor depth;      // N x 1, in FaceOutputs::kDepthUnit, from an origin of its own
  torch::Tensor log_level;  // N x 1, logarithm of the mean over channels of the shading
  torch::Tensor colour;     // N x 3, of the shading; mean over channels 1, > 0
  torch::Tensor region;     // N x kRegionCount, scores before the softmax
  // The same two of what the shading would be if nothing stood in the light's way; undefined for a network without.
  torch::Tensor open_log_level = {};
  torch::Tensor open_colour = {};
};

struct FaceInput {
  torch::Tensor channels;  // N x FaceInputs::kCount x H x W
  torch::Tensor gain;      // N x 1 x 1 x 1: what the picture was multiplied by
};
// N pictures: linear light, which channels of it are clipped, where the face is, and the mesh's normals. Throws std::invalid_argument for
// other numbers of channels.
FaceInput prepare_face_input(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask,
                             const torch::Tensor& mesh);

// The raw output's channels of the highlight, for highlight_from_raw(), and all others, for surface_from_raw().
struct FaceRaw {
  torch::Tensor highlight, surface;
};
// `raw`: N x FaceOutputs::kCount x H x W, or kCountWithoutOpen. Throws std::invalid_argument for another number of channels.
FaceRaw split_face_raw(const torch::Tensor& raw);

// `surface_raw`: the channels that split_face_raw() gives, of a picture multiplied by `gain`. Throws std::invalid_argument for another number of them.
FaceSurface surface_from_raw(const torch::Tensor& surface_raw, const torch::Tensor& gain);

}  // namespace faceprobe::net

#pragma once
// Internal: how far the face network's surface and light are from what is known, as one number to lower.

#include "faceprobe/train/config.h"
#include "net/torch/face_head.h"
#include "train/batch.h"

#include <torch/torch.h>

namespace faceprobe::train {

// Of everything but the highlights, which loss.h has. `truth.surface` must be there.
torch::Tensor surface_loss(const net::FaceSurface& found, const SurfaceBatch& truth, const LossConfig& config);

// N x 1 x H x W: length of the chord between two fields of directions, nearly the angle between them in radians; 0 to 2. Smooth where they
// meet. Of any length but 0.
torch::Tensor chord(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace faceprobe::train

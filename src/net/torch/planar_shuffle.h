#pragma once
// Internal: torch::pixel_shuffle for a network whose features lie channel by channel beside one another (channels last) and whose outputs are then
// read plane by plane. libtorch's keeps the features' order, and every split, clamp and logarithm after it walks a few floats of each pixel.
//
//   torch::Tensor planes = planar_pixel_shuffle(head(features), 2);   // N x 4C x H x W -> N x C x 2H x 2W, plane by plane

#include <torch/torch.h>
#include <cstdint>

namespace faceprobe::net {

// The numbers of torch::pixel_shuffle(x, fold) for x of N x (C fold^2) x H x W. In single precision on the processor the result is contiguous, and
// has first derivatives alone; else it is torch::pixel_shuffle's own.
torch::Tensor planar_pixel_shuffle(const torch::Tensor& x, std::int64_t fold);

}  // namespace faceprobe::net

#pragma once
// Pictures to tensors and back. The interleaved channels of a picture are libtorch's channels-last format, in which its
// convolutions on a processor are fast, so the tensors are views and nothing is rearranged.

#include "faceprobe/core/image.h"

#include <torch/torch.h>

namespace faceprobe::net {

// The three inputs, as long and wide as the next multiples: the last row and column are repeated beyond the picture.
struct PaddedPicture {
  Image linear;  // 3 channels; NaN, infinity and what is below zero have become 0
  Image clip;    // 3 channels of 0 and 1
  Image mask;    // 1 channel of 0 and 1
};
// `linear`: H x W x 3, not empty. `clip`: H x W x 1, bits 0 to 2 are the channels; empty = nothing was clipped. `mask`: H x W x 1,
// non-zero on the face; empty = everywhere.
PaddedPicture pad_picture(const Image& linear, const ByteImage& clip, const ByteImage& mask, int multiple);

// 1 x channels x height x width, channels-last; a view that is valid as long as the picture.
torch::Tensor tensor_view(Image& picture);

// The top left `width` x `height` pixels of a 1 x 3 x H x W tensor on any device.
Image crop_to_picture(const torch::Tensor& tensor, int width, int height);

}  // namespace faceprobe::net

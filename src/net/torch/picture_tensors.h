#pragma once
// Pictures to tensors and back. The interleaved channels of a picture are libtorch's channels-last format, in which its
// convolutions on a processor are fast, so the tensors are views and nothing is rearranged.

#include "faceprobe/core/image.h"

#include <torch/torch.h>

namespace faceprobe::net {

// 1 x channels x height x width, channels-last; a view that is valid as long as the picture.
torch::Tensor tensor_view(Image& picture);

// The top left `width` x `height` pixels of a 1 x 3 x H x W tensor on any device.
Image crop_to_picture(const torch::Tensor& tensor, int width, int height);

}  // namespace faceprobe::net

#pragma once
// A weights file brought to life: the network it names, with what goes in and what comes out, behind one call that is the same
// for every architecture.

#include "faceprobe/io/safetensors.h"
#include "faceprobe/net/model_file.h"

#include <torch/torch.h>
#include <functional>

namespace faceprobe::net {

struct Separator {
  int multiple = 1;  // height and width must be multiples of it
  // `linear`: N x 3 x H x W, finite, >= 0; `clip`: N x 3 x H x W of 0 and 1; `mask`: N x 1 x H x W of 0 and 1; all float, on the
  // separator's device. Result: N x 3 x H x W, 0 <= highlight <= linear.
  std::function<torch::Tensor(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask)> highlight;
};

// Throws Error(kModel): an unknown architecture, options that are not its own, weights that do not fit.
Separator make_separator(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device);

}  // namespace faceprobe::net

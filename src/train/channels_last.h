#pragma once

#include <torch/torch.h>

namespace faceprobe::train {

// Kernels of convolutions as the batches lie in memory (train/batch.h), so that libtorch need not turn one or the other at each step. The
// numbers stay; sums may be taken in another order. Convolutions that grow are left: not every libtorch has them in this order.
inline void to_channels_last(torch::nn::Module& module) {
  const torch::NoGradGuard no_grad;
  for (const auto& part : module.modules()) {
    if (const auto* conv = part->as<torch::nn::Conv2d>())
      torch::Tensor(conv->weight).set_data(conv->weight.contiguous(torch::MemoryFormat::ChannelsLast));
  }
}

}  // namespace faceprobe::train

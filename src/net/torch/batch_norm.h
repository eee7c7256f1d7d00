#pragma once
// Batch normalisation over all axes but the second, with a running mean and variance (Ioffe & Szegedy 2015). Not torch::nn::BatchNorm2d: that
// also counts batches, a whole number, and weights files hold none.

#include <torch/torch.h>

namespace faceprobe::net {

class BatchNormImpl : public torch::nn::Module {
 public:
  explicit BatchNormImpl(int channels);
  // N x C or N x C x H x W -> the same. In training by the batch's own mean and variance, of which a tenth goes into the running ones.
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::Tensor weight_, bias_, mean_, variance_;
};
TORCH_MODULE(BatchNorm);

}  // namespace faceprobe::net

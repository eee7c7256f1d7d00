#include "net/torch/batch_norm.h"

namespace faceprobe::net {
namespace {

// Torch's defaults.
constexpr double kFollow = 0.1;  // share of a batch in the running mean and variance
constexpr double kLeastVariance = 1e-5;

}  // namespace

BatchNormImpl::BatchNormImpl(int channels)
    : weight_(register_parameter("weight", torch::ones({channels}))),
      bias_(register_parameter("bias", torch::zeros({channels}))),
      mean_(register_buffer("mean", torch::zeros({channels}))),
      variance_(register_buffer("variance", torch::ones({channels}))) {}

torch::Tensor BatchNormImpl::forward(const torch::Tensor& x) {
  return torch::batch_norm(x, weight_, bias_, mean_, variance_, is_training(), kFollow, kLeastVariance, false);
}

}  // namespace faceprobe::net

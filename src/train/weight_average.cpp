#include "train/weight_average.h"

#include <algorithm>

namespace faceprobe::train {
namespace {

std::vector<torch::Tensor> averaged_of(const torch::nn::Module& module, Averaged which) {
  std::vector<torch::Tensor> numbers = module.parameters();
  if (which == Averaged::kParameters) return numbers;
  for (const torch::Tensor& buffer : module.buffers()) {
    if (buffer.is_floating_point()) numbers.push_back(buffer);
  }
  return numbers;
}

}  // namespace

WeightAverage::WeightAverage(const torch::nn::Module& module, double decay, Averaged which)
    : decay_(decay), which_(which) {
  for (const torch::Tensor& number : averaged_of(module, which)) values_.push_back(number.detach().clone());
}

void WeightAverage::add(const torch::nn::Module& module, std::int64_t step) {
  const torch::NoGradGuard no_grad;
  const double decay = std::min(decay_, (1.0 + static_cast<double>(step)) / (10.0 + static_cast<double>(step)));
  const std::vector<torch::Tensor> parameters = averaged_of(module, which_);
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i].lerp_(parameters[i].detach(), 1.0 - decay);
}

void WeightAverage::swap(torch::nn::Module& module) {
  const torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> parameters = averaged_of(module, which_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const torch::Tensor held = parameters[i].detach().clone();
    parameters[i].copy_(values_[i]);
    values_[i].copy_(held);
  }
}

}  // namespace faceprobe::train

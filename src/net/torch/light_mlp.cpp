#include "net/torch/light_mlp.h"

#include <stdexcept>

namespace faceprobe::net {

LightMlpImpl::LightMlpImpl(const LightOptions& options) : options_(options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  mean_ = register_buffer("mean", torch::zeros({options.inputs}));
  scale_ = register_buffer("scale", torch::ones({options.inputs}));
  int in = options.inputs;
  for (std::size_t i = 0; i <= options.hidden.size(); ++i) {
    const int out = i < options.hidden.size() ? options.hidden[i] : options.outputs;
    layers_->push_back(torch::nn::Linear(in, out));
    in = out;
  }
  register_module("layers", layers_);
}

void LightMlpImpl::standardise(const torch::Tensor& examples) {
  constexpr double kLeastSpread = 0.02;  // of inputs that hardly change
  const torch::NoGradGuard no_grad;
  mean_.copy_(examples.mean(0));
  scale_.copy_(1 / (examples.std(0, false) + kLeastSpread));
}

torch::Tensor LightMlpImpl::forward(const torch::Tensor& features, double drop) {
  torch::Tensor x = (features - mean_) * scale_;
  for (std::size_t i = 0; i < layers_->size(); ++i) {
    x = layers_[i]->as<torch::nn::Linear>()->forward(x);
    if (i + 1 == layers_->size()) break;
    x = torch::dropout(torch::leaky_relu(x, LightOptions::kSlope), drop, is_training() && drop > 0);
  }
  return x.clamp(-LightOptions::kLargestLog, LightOptions::kLargestLog);
}

}  // namespace faceprobe::net

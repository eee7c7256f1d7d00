#pragma once
// The light prior's network for training (faceprobe/net/light_prior.h runs it): layers of sums with a leaky unit between, the logarithm of
// radiance at the end.
//
//   LightMlp net(LightOptions{.inputs = 3456, .outputs = 576});
//   torch::Tensor log_radiance = net(features);   // N x inputs -> N x outputs

#include "net/light_options.h"

#include <torch/torch.h>

namespace faceprobe::net {

class LightMlpImpl : public torch::nn::Module {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit LightMlpImpl(const LightOptions& options);

  // What the inputs are like, from N x inputs examples: they are brought to mean 0 and about unit spread.
  void standardise(const torch::Tensor& examples);
  // `drop`: share of the hidden units left out while training.
  torch::Tensor forward(const torch::Tensor& features, double drop = 0);

  const LightOptions& options() const { return options_; }

 private:
  LightOptions options_;
  torch::Tensor mean_, scale_;
  torch::nn::ModuleList layers_;
};
TORCH_MODULE(LightMlp);

}  // namespace faceprobe::net

#pragma once
// The Albedo-Shading network of the paper (Sec. 4.3): MSCR of Narihira, Maire & Yu 2015 as it was released, with a branch for each of two layers.
// It is given a diffuse layer and says both in logarithms, each up to a level, since its loss (train/albedo_shading_loss.h) leaves that free.
//
//   AlbedoShading net(AlbedoShadingOptions{});
//   net->eval();                                                               // else dropout is at work
//   const LogLayers logs = net(albedo_shading_input(diffuse, net->options()));  // N x 3 x H x W; H, W multiples of 32
//   const torch::Tensor shading = light_of_log(logs.shading, net->options());

#include "net/torch/mscr.h"

#include <torch/torch.h>
#include <array>
#include <string>

namespace faceprobe::net {

struct AlbedoShadingOptions {
  std::array<float, 3> mean = MscrOptions{}.mean;  // subtracted from the input, as MSCR's
  // Added to a layer before its logarithm. 0.5 is the released network's, for code values of 0 to 1. As the level is free, a share of the offset
  // stays in the light that comes back: a grey that is no harm while the offset is small.
  float offset = 0.5F;
  int divisor = 1;  // of the released network's numbers of channels: 1, 2, 4, 8 or 16. For small tests

  std::string validate() const;
  bool operator==(const AlbedoShadingOptions&) const = default;
};
std::string options_json(const AlbedoShadingOptions& options);
// Throws Error(kModel).
AlbedoShadingOptions albedo_shading_options_from_json(const std::string& text);

// `diffuse`: N x 3 x H x W, linear. Clamped to 0 to 1, less the mean.
torch::Tensor albedo_shading_input(const torch::Tensor& diffuse, const AlbedoShadingOptions& options);

// log(light + offset), and back: 0 or more.
torch::Tensor log_of_light(const torch::Tensor& light, const AlbedoShadingOptions& options);
torch::Tensor light_of_log(const torch::Tensor& log, const AlbedoShadingOptions& options);

// N x 3 x H x W each.
struct LogLayers {
  torch::Tensor albedo, shading;
};

class AlbedoShadingImpl : public MscrTrunk {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit AlbedoShadingImpl(const AlbedoShadingOptions& options);
  // Throws std::invalid_argument for another number of channels or a size that is no multiple of 32.
  LogLayers forward(const torch::Tensor& x);

  const AlbedoShadingOptions& options() const { return options_; }

 private:
  AlbedoShadingOptions options_;
  Branch albedo_, shading_;
};
TORCH_MODULE(AlbedoShading);

}  // namespace faceprobe::net

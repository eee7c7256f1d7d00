#include "net/torch/face_head.h"

#include "net/face_outputs.h"
#include "net/head.h"

#include <stdexcept>

namespace faceprobe::net {

FaceSurface surface_from_raw(const torch::Tensor& raw) {
  using Out = FaceOutputs;
  if (raw.dim() != 4 || raw.size(1) != Out::kCount) {
    throw std::invalid_argument("face head: the raw output must be N x " + std::to_string(Out::kCount) + " x H x W");
  }
  const torch::Tensor full = raw.to(torch::kFloat).clamp(-Head::kLargestRaw, Head::kLargestRaw);
  const torch::Tensor towards_viewer = torch::tensor({0.0F, 0.0F, 1.0F}, full.options()).view({1, 3, 1, 1});
  const torch::Tensor free = full.narrow(1, Out::kNormal, 3) + towards_viewer;
  const torch::Tensor length = free.square().sum(1, true).clamp_min(Out::kShortest * Out::kShortest).sqrt();
  const auto logarithm = [&](int channel) {
    return full.narrow(1, channel, 1).clamp(-Out::kLargestLog, Out::kLargestLog);
  };
  const torch::Tensor colour = torch::softplus(full.narrow(1, Out::kShading + 1, 3)) + Head::kColourFloor;
  return {free / length,
          Out::kUsualError * logarithm(Out::kSpread).exp(),
          full.narrow(1, Out::kDepth, 1),
          logarithm(Out::kShading),
          colour / colour.mean(1, true),
          full.narrow(1, Out::kRegion, kRegionCount)};
}

}  // namespace faceprobe::net

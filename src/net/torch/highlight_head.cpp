#include "net/torch/highlight_head.h"

#include "faceprobe/core/color.h"

#include <stdexcept>
#include <vector>

namespace faceprobe::net {
namespace {

void require_channels(const torch::Tensor& tensor, int channels, const char* what) {
  if (tensor.dim() != 4 || tensor.size(1) != channels) {
    throw std::invalid_argument(std::string("highlight head: ") + what + " must be N x " + std::to_string(channels) +
                                " x H x W");
  }
}

// b I / (b^4 + I^4)^(1/4), which is I f(b / I). By way of the smaller and the larger of the two nothing is divided by zero,
// nothing overflows, and the result is at most the smaller in floating point too.
torch::Tensor smooth_min(const torch::Tensor& b, const torch::Tensor& light) {
  const torch::Tensor smaller = torch::minimum(b, light);
  const torch::Tensor ratio = smaller / (torch::maximum(b, light) + Head::kTiny);
  return smaller / (1 + ratio.square().square()).sqrt().sqrt();
}

}  // namespace

torch::Tensor luminance(const torch::Tensor& light) {
  return kRedLuminance * light.narrow(1, 0, 1) + kGreenLuminance * light.narrow(1, 1, 1) +
         kBlueLuminance * light.narrow(1, 2, 1);
}

torch::Tensor prepare_input(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask) {
  require_channels(linear, 3, "the picture");
  require_channels(clip, 3, "the clip flags");
  require_channels(mask, 1, "the mask");
  const torch::Tensor encoded = linear.clamp(Head::kDarkest, Head::kBrightest).pow(1 / Head::kGamma);
  return torch::cat({encoded, clip.to(linear.scalar_type()), mask.to(linear.scalar_type())}, 1) - 0.5;
}

torch::Tensor highlight_from_raw(const torch::Tensor& raw, const torch::Tensor& linear) {
  require_channels(raw, kRawChannels, "the raw output");
  require_channels(linear, 3, "the picture");
  const torch::Tensor light = linear.clamp_min(0);
  // Mixed precision ends here: the bound holds only in the picture's own.
  const torch::Tensor full = raw.to(linear.scalar_type()).clamp(-Head::kLargestRaw, Head::kLargestRaw);
  // Split, not narrowed: the way back joins the parts once, where each narrow() would fill and add a tensor as large as all of them.
  const std::vector<torch::Tensor> parts = full.split_with_sizes({1, 3}, 1);
  const torch::Tensor amount = torch::softplus(parts[0] + Head::kAmountOffset);
  const torch::Tensor unscaled = torch::softplus(parts[1]) + Head::kColourFloor;
  const torch::Tensor colour = unscaled / unscaled.mean(1, true);
  return smooth_min(luminance(light) * amount * colour, light);
}

}  // namespace faceprobe::net

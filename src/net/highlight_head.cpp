#include "net/highlight_head.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

constexpr double kGamma = 2.2;
constexpr double kDarkest = 1e-6;  // keeps the slope of the encoding finite at black
constexpr double kBrightest = 64;
constexpr double kAmountOffset = -2;   // softplus(-2) = 0.127
constexpr double kColourFloor = 1e-3;  // a colour stays defined where all three outputs are far below zero
constexpr double kLargestRaw = 100;    // far beyond use; products of larger ones would overflow
constexpr double kTiny = 1e-30;        // 0 / 0 becomes 0

void require_channels(const torch::Tensor& tensor, int channels, const char* what) {
  if (tensor.dim() != 4 || tensor.size(1) != channels) {
    throw std::invalid_argument(std::string("highlight head: ") + what + " must be N x " + std::to_string(channels) +
                                " x H x W");
  }
}

torch::Tensor luminance(const torch::Tensor& light) {
  return 0.2126 * light.narrow(1, 0, 1) + 0.7152 * light.narrow(1, 1, 1) + 0.0722 * light.narrow(1, 2, 1);
}

// b I / (b^4 + I^4)^(1/4), which is I f(b / I). By way of the smaller and the larger of the two nothing is divided by zero,
// nothing overflows, and the result is at most the smaller in floating point too.
torch::Tensor smooth_min(const torch::Tensor& b, const torch::Tensor& light) {
  const torch::Tensor smaller = torch::minimum(b, light);
  const torch::Tensor ratio = smaller / (torch::maximum(b, light) + kTiny);
  return smaller / (1 + ratio.square().square()).sqrt().sqrt();
}

}  // namespace

torch::Tensor prepare_input(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask) {
  require_channels(linear, 3, "the picture");
  require_channels(clip, 3, "the clip flags");
  require_channels(mask, 1, "the mask");
  const torch::Tensor encoded = linear.clamp(kDarkest, kBrightest).pow(1 / kGamma);
  return torch::cat({encoded, clip.to(linear.scalar_type()), mask.to(linear.scalar_type())}, 1) - 0.5;
}

torch::Tensor highlight_from_raw(const torch::Tensor& raw, const torch::Tensor& linear) {
  require_channels(raw, kRawChannels, "the raw output");
  require_channels(linear, 3, "the picture");
  const torch::Tensor light = linear.clamp_min(0);
  // Mixed precision ends here: the bound holds only in the picture's own.
  const torch::Tensor full = raw.to(linear.scalar_type()).clamp(-kLargestRaw, kLargestRaw);
  const torch::Tensor amount = torch::softplus(full.narrow(1, 0, 1) + kAmountOffset);
  const torch::Tensor unscaled = torch::softplus(full.narrow(1, 1, 3)) + kColourFloor;
  const torch::Tensor colour = unscaled / unscaled.mean(1, true);
  return smooth_min(luminance(light) * amount * colour, light);
}

}  // namespace faceprobe::net

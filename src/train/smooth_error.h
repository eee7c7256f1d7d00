#pragma once
// Internal: what the losses of pictures are made of.

#include <torch/types.h>

namespace faceprobe::train {

// Below it an absolute error is rounded off: an eighth of a code value in the middle of the range.
inline constexpr double kCorner = 1e-3;

inline torch::Tensor smooth_abs(const torch::Tensor& x) { return (x.square() + kCorner * kCorner).sqrt() - kCorner; }

// Over all channels of an error, B x C x H x W, by one weight a pixel, B x 1 x H x W; 0 where no pixel counts.
inline torch::Tensor weighted_mean(const torch::Tensor& error, const torch::Tensor& weight) {
  return (error * weight).sum() / (weight.sum() * static_cast<double>(error.size(1)) + 1e-6);
}

}  // namespace faceprobe::train

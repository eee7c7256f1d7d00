#pragma once
// What goes into the small network and what its raw output means, for training and in batches. net/head.h is the same for one picture.
//
//   torch::Tensor raw = unet(prepare_input(linear, clip, mask));
//   torch::Tensor highlight = highlight_from_raw(raw, linear);

#include "net/head.h"

#include <torch/torch.h>

namespace faceprobe::net {

// N x 3 x H x W to N x 1 x H x W, Rec.709.
torch::Tensor luminance(const torch::Tensor& light);

// `linear`: N x 3 x H x W, light, finite; negative counts as 0. `clip`: N x 3 x H x W, 1 where the photo was clipped, else 0.
// `mask`: N x 1 x H x W, 1 on the face. Flags of any type become that of `linear`. Result: N x 7 x H x W, every channel between
// -0.5 and 0.5 as long as the light is below the photo's white. Light is encoded as x^(1/2.2): dark and bright skin get a like
// share of the range. Light above 64 is the same to the network.
torch::Tensor prepare_input(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask);

// `raw`: N x 4 x H x W, any finite numbers. `linear`: as above. Result: N x 3 x H x W highlight with 0 <= H <= max(linear, 0)
// in every channel. With Y the luminance of the pixel,
//   amount b_c = Y softplus(raw_0 - 2) colour_c,   colour = softplus(raw_1..3) / their mean,
//   H_c = I_c f(b_c / I_c),   f(t) = t / (1 + t^4)^(1/4).
// The light's colour is its own output and not that of the picture, because a highlight on skin has the colour of the light;
// f is t for small t and tends to 1, so that the bound holds without a corner where the gradient ends. The share is of the
// pixel's own luminance, so exposure cancels out. raw = 0 is grey light, an eighth of the luminance.
torch::Tensor highlight_from_raw(const torch::Tensor& raw, const torch::Tensor& linear);

}  // namespace faceprobe::net

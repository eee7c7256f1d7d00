#pragma once
// The network of Shi, Dong, Su & Yu 2017, "Learning Non-Lambertian Object Intrinsics across ShapeNet Categories" (CVPR): a picture into
// three layers, picture = albedo x shading + highlight. For comparing with it; unet.h is what is used.
//
// Sizes and order of the layers follow the released network (shi-jian/shapenet-intrinsics, Torch). Six 3x3 convolutions, all but the first
// halving the picture, see it; three decoders, one a layer of the answer, each begin with four more at the smallest size and grow back by
// bilinear interpolation. At every size each decoder sees the encoder's features of that size and those of all three decoders, side by
// side. Behind every convolution, the last included, are batch normalisation and ReLU, so no layer is below 0.
//
//   Shi net(ShiOptions{});
//   net->eval();                                                // else it normalises by the batch at hand
//   const ShiLayers out = net(shi_input(linear));               // N x 3 x H x W -> the same size; H, W multiples of net->multiple()

#include "net/torch/batch_norm.h"

#include <torch/torch.h>
#include <array>
#include <string>

namespace faceprobe::net {

struct ShiOptions {
  std::array<int, 6> widths = {16,  32,  64,
                               128, 256, 256};  // channels of the encoder at each size; a decoder has as many
  int first_stride =
      1;  // of the first convolution. 2 = all but the end at half the size: a quarter of the work, less sharp

  std::string validate() const;
  bool operator==(const ShiOptions&) const = default;
};
std::string options_json(const ShiOptions& options);
// Throws Error(kModel).
ShiOptions shi_options_from_json(const std::string& text);

// `linear`: N x 3 x H x W. Light clamped to 0 to 1.
torch::Tensor shi_input(const torch::Tensor& linear);

// N x 3 x H x W each, 0 or more.
struct ShiLayers {
  torch::Tensor albedo, shading, highlight;
};

// A 3x3 convolution, batch normalisation and ReLU.
class ShiUnitImpl : public torch::nn::Module {
 public:
  ShiUnitImpl(int in, int out, int stride, int groups);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::Conv2d conv_;
  BatchNorm norm_;
};
TORCH_MODULE(ShiUnit);

class ShiImpl : public torch::nn::Module {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit ShiImpl(const ShiOptions& options);
  // Throws std::invalid_argument for another number of channels, a size that is no multiple, and in training for a batch that has one pixel
  // left at the smallest size, whose variance is not known.
  ShiLayers forward(const torch::Tensor& x);

  const ShiOptions& options() const { return options_; }
  int multiple() const { return 32 * options_.first_stride; }

 private:
  ShiOptions options_;
  // All three decoders see the same features, so their convolutions of one size are one with three times the outputs.
  torch::nn::ModuleList encoder_, middle_, decoder_;
  ShiUnit last_{nullptr}, layers_{nullptr};
};
TORCH_MODULE(Shi);

}  // namespace faceprobe::net

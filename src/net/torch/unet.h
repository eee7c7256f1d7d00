#pragma once
// The small network of the highlight separation: an encoder and a decoder with skips, fast enough for a processor. It puts
// out raw numbers; highlight_head.h makes light of them. For training; src/net/unet_runner.h is the same network without libtorch.
//
// The picture is first folded 2 x 2 into channels, so nothing is lost and every convolution runs at half size or below. Level i
// has widths[i] channels at 1 / 2^(i+1) of the size. Sizes grow by repeating pixels before a convolution, never by a
// transposed convolution, whose uneven overlap leaves a checkerboard.
//
//   UNet net(UNetOptions{});
//   torch::Tensor raw = net(input);   // N x in x H x W -> N x out x H x W; H, W multiples of net->multiple()

#include "net/unet_options.h"

#include <torch/torch.h>
#include <vector>

namespace faceprobe::net {

// 3x3 convolution, group norm, SiLU. The norm takes its statistics over one whole picture and none over the batch, so training
// on batches of any size and inference agree; the price is that crops should frame a face as they did in training.
class ConvUnitImpl : public torch::nn::Module {
 public:
  ConvUnitImpl(int in, int out, int stride);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::Conv2d conv_;
  torch::nn::GroupNorm norm_;
};
TORCH_MODULE(ConvUnit);

// The first unit brings the features to the level's width and size, the others add a correction to what it found.
class LevelImpl : public torch::nn::Module {
 public:
  LevelImpl(int in, int out, int stride, int convs);
  torch::Tensor forward(const torch::Tensor& x);

 private:
  torch::nn::ModuleList units_;
};
TORCH_MODULE(Level);

class UNetImpl : public torch::nn::Module {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit UNetImpl(const UNetOptions& options);
  // Throws std::invalid_argument for another number of channels or a size that is no multiple.
  torch::Tensor forward(const torch::Tensor& x);

  const UNetOptions& options() const { return options_; }
  int multiple() const { return options_.multiple(); }

 private:
  UNetOptions options_;
  torch::nn::ModuleList encoder_, decoder_;       // by level, finest first
  torch::nn::ModuleList from_skip_, from_below_;  // 1x1, by level of the decoder
  torch::nn::Conv2d head_{nullptr};
};
TORCH_MODULE(UNet);

}  // namespace faceprobe::net

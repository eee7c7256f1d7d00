#include "net/torch/unet.h"

#include "net/torch/planar_shuffle.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

torch::nn::Conv2d conv_1x1(int in, int out) { return torch::nn::Conv2d(torch::nn::Conv2dOptions(in, out, 1)); }

}  // namespace

ConvUnitImpl::ConvUnitImpl(int in, int out, int stride)
    : conv_(torch::nn::Conv2dOptions(in, out, 3).stride(stride).padding(1).bias(false)),
      norm_(torch::nn::GroupNormOptions(kNormGroups, out).eps(kNormFloor)) {
  register_module("conv", conv_);
  register_module("norm", norm_);
}

torch::Tensor ConvUnitImpl::forward(const torch::Tensor& x) { return torch::silu(norm_(conv_(x))); }

LevelImpl::LevelImpl(int in, int out, int stride, int convs) {
  for (int i = 0; i < convs; ++i) units_->push_back(i == 0 ? ConvUnit(in, out, stride) : ConvUnit(out, out, 1));
  register_module("units", units_);
}

torch::Tensor LevelImpl::forward(const torch::Tensor& x) {
  const torch::Tensor base = units_[0]->as<ConvUnit>()->forward(x);
  if (units_->size() == 1) return base;
  torch::Tensor correction = base;
  for (std::size_t i = 1; i < units_->size(); ++i) correction = units_[i]->as<ConvUnit>()->forward(correction);
  return base + correction;
}

UNetImpl::UNetImpl(const UNetOptions& options) : options_(options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  const std::vector<int>& widths = options.widths;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const int in = i == 0 ? options.in_channels * kFold * kFold : widths[i - 1];
    encoder_->push_back(Level(in, widths[i], i == 0 ? 1 : 2, options.convs_per_level));
    if (i + 1 == widths.size()) break;
    from_skip_->push_back(conv_1x1(widths[i], widths[i]));
    from_below_->push_back(conv_1x1(widths[i + 1], widths[i]));
    decoder_->push_back(Level(widths[i], widths[i], 1, options.convs_per_level));
  }
  head_ = torch::nn::Conv2d(torch::nn::Conv2dOptions(widths[0], options.out_channels * kFold * kFold, 3).padding(1));
  register_module("encoder", encoder_);
  register_module("from_skip", from_skip_);
  register_module("from_below", from_below_);
  register_module("decoder", decoder_);
  register_module("head", head_);
}

torch::Tensor UNetImpl::forward(const torch::Tensor& x) {
  if (x.dim() != 4 || x.size(1) != options_.in_channels || x.size(2) % multiple() != 0 || x.size(3) % multiple() != 0) {
    throw std::invalid_argument("UNet: the input must be N x " + std::to_string(options_.in_channels) +
                                " x H x W with H and W multiples of " + std::to_string(multiple()));
  }
  std::vector<torch::Tensor> skips;
  torch::Tensor features = torch::pixel_unshuffle(x, kFold);
  // Folding leaves the memory plane by plane; from here on the caller's format holds.
  features = features.contiguous(x.suggest_memory_format());
  for (const auto& level : *encoder_) {
    features = level->as<Level>()->forward(features);
    skips.push_back(features);
  }
  for (std::size_t i = decoder_->size(); i-- > 0;) {
    // A 1x1 convolution of (skip, upsampled) side by side is the sum of two, and costs the coarse part a quarter before it grows.
    const torch::Tensor below = from_below_[i]->as<torch::nn::Conv2d>()->forward(features);
    const torch::Tensor skip = from_skip_[i]->as<torch::nn::Conv2d>()->forward(skips[i]);
    features = skip + torch::upsample_nearest2d(below, {skip.size(2), skip.size(3)});
    features = decoder_[i]->as<Level>()->forward(features);
  }
  return planar_pixel_shuffle(head_(features), kFold);
}

}  // namespace faceprobe::net

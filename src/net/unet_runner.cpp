#include "net/unet_runner.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace faceprobe::net {
namespace {

// 2 x 2 pixels side by side in the channels: channel 4 c + 2 dy + dx, as libtorch's pixel_unshuffle has it.
Image fold(const Image& picture) {
  Image folded(picture.width() / kFold, picture.height() / kFold, picture.channels() * kFold * kFold);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float* from = picture.pixel(x, y);
      float* to = folded.pixel(x / kFold, y / kFold) + kFold * (y % kFold) + x % kFold;
      for (int c = 0; c < picture.channels(); ++c) to[kFold * kFold * c] = from[c];
    }
  }
  return folded;
}

Image unfold(const Image& folded) {
  Image picture(folded.width() * kFold, folded.height() * kFold, folded.channels() / (kFold * kFold));
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float* from = folded.pixel(x / kFold, y / kFold) + kFold * (y % kFold) + x % kFold;
      float* to = picture.pixel(x, y);
      for (int c = 0; c < picture.channels(); ++c) to[c] = from[kFold * kFold * c];
    }
  }
  return picture;
}

// Every pixel of `below` four times, added to `features`.
void add_grown(const Image& below, Image& features) {
  const int channels = features.channels();
  for (int y = 0; y < features.height(); ++y) {
    for (int x = 0; x < features.width(); ++x) {
      const float* from = below.pixel(x / 2, y / 2);
      float* to = features.pixel(x, y);
      for (int c = 0; c < channels; ++c) to[c] += from[c];
    }
  }
}

}  // namespace

UNetRunner::UNetRunner(const UNetOptions& options, WeightList& weights) : options_(options) {
  const std::vector<int>& widths = options.widths;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const std::string level = std::to_string(i);
    const int in = i == 0 ? options.in_channels * kFold * kFold : widths[i - 1];
    encoder_.push_back(make_level(weights, "encoder." + level, in, widths[i], i == 0 ? 1 : 2));
    if (i + 1 == widths.size()) break;
    from_skip_.emplace_back(weights, "from_skip." + level,
                            ConvolutionShape{.in = widths[i], .out = widths[i], .kernel = 1, .bias = true});
    from_below_.emplace_back(weights, "from_below." + level,
                             ConvolutionShape{.in = widths[i + 1], .out = widths[i], .kernel = 1, .bias = true});
    decoder_.push_back(make_level(weights, "decoder." + level, widths[i], widths[i], 1));
  }
  head_.emplace_back(weights, "head",
                     ConvolutionShape{.in = widths[0], .out = options.out_channels * kFold * kFold, .bias = true});
}

UNetRunner::Level UNetRunner::make_level(WeightList& weights, const std::string& name, int in, int out,
                                         int stride) const {
  Level level;
  for (int i = 0; i < options_.convs_per_level; ++i) {
    const std::string unit = name + ".units." + std::to_string(i);
    const ConvolutionShape shape{.in = i == 0 ? in : out, .out = out, .stride = i == 0 ? stride : 1};
    level.push_back({Convolution(weights, unit + ".conv", shape), GroupNormSilu(weights, unit + ".norm", out)});
  }
  return level;
}

Image UNetRunner::Unit::operator()(const Image& features) const {
  Image out = convolution(features);
  norm.apply(out);
  return out;
}

Image UNetRunner::run(const Level& level, const Image& features) {
  Image base = level[0](features);
  if (level.size() == 1) return base;
  Image correction = level[1](base);
  for (std::size_t i = 2; i < level.size(); ++i) correction = level[i](correction);
  std::transform(base.values().begin(), base.values().end(), correction.values().begin(), base.values().begin(),
                 std::plus<>());
  return base;
}

Image UNetRunner::operator()(const Image& input) const {
  const int multiple = options_.multiple();
  if (input.channels() != options_.in_channels || input.width() % multiple != 0 || input.height() % multiple != 0) {
    throw std::invalid_argument("The network's input must have " + std::to_string(options_.in_channels) +
                                " channels, and sides that are multiples of " + std::to_string(multiple));
  }
  std::vector<Image> skips;
  for (const Level& level : encoder_) {
    Image found = skips.empty() ? run(level, fold(input)) : run(level, skips.back());
    skips.push_back(std::move(found));
  }
  Image features = std::move(skips.back());
  for (std::size_t i = decoder_.size(); i-- > 0;) {
    // A 1x1 convolution of (skip, upsampled) side by side is the sum of two.
    Image both = from_skip_[i](skips[i]);
    add_grown(from_below_[i](features), both);
    features = run(decoder_[i], both);
  }
  return unfold(head_.front()(features));
}

}  // namespace faceprobe::net

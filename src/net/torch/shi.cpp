#include "net/torch/shi.h"

#include "net/option_reader.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::net {
namespace {

constexpr int kDecoders = 3;     // albedo, shading, highlight
constexpr int kMiddleUnits = 4;  // convolutions of a decoder at the smallest size
constexpr int kWidestShi = 512;  // options from a file cannot ask for more memory than there is

torch::Tensor grow_2_times(const torch::Tensor& x) {
  return torch::upsample_bilinear2d(x, {2 * x.size(2), 2 * x.size(3)}, false);
}

torch::Tensor run_unit(const std::shared_ptr<torch::nn::Module>& unit, const torch::Tensor& x) {
  return unit->as<ShiUnit>()->forward(x);
}

}  // namespace

std::string ShiOptions::validate() const {
  for (const int width : widths) {
    if (width < 1 || width > kWidestShi)
      return "A width is " + std::to_string(width) + "; each must lie in 1 to " + std::to_string(kWidestShi) + ".";
  }
  if (first_stride != 1 && first_stride != 2)
    return "first_stride is " + std::to_string(first_stride) + "; it must be 1 or 2.";
  return {};
}

std::string options_json(const ShiOptions& options) {
  return nlohmann::json{{"widths", options.widths}, {"first_stride", options.first_stride}}.dump();
}

ShiOptions shi_options_from_json(const std::string& text) {
  OptionReader reader(text);
  const std::vector<int> widths = reader.integers("widths");
  ShiOptions options;
  options.first_stride = reader.integer("first_stride");
  reader.finish();
  const std::size_t wanted = options.widths.size();
  require_valid_options(widths.size() == wanted ? ""
                                                : "widths has " + std::to_string(widths.size()) + " numbers; " +
                                                      std::to_string(wanted) + " are wanted.");
  std::ranges::copy(widths, options.widths.begin());
  require_valid_options(options.validate());
  return options;
}

torch::Tensor shi_input(const torch::Tensor& linear) { return linear.clamp(0, 1); }

// The normalisation takes off whatever bias a convolution has.
ShiUnitImpl::ShiUnitImpl(int in, int out, int stride, int groups)
    : conv_(torch::nn::Conv2dOptions(in, out, 3).stride(stride).padding(1).groups(groups).bias(false)), norm_(out) {
  register_module("conv", conv_);
  register_module("norm", norm_);
}

torch::Tensor ShiUnitImpl::forward(const torch::Tensor& x) { return torch::relu(norm_(conv_(x))); }

ShiImpl::ShiImpl(const ShiOptions& options) : options_(options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  const std::array<int, 6>& widths = options.widths;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const int in = i == 0 ? 3 : widths[i - 1];
    encoder_->push_back(ShiUnit(in, widths[i], i == 0 ? options.first_stride : 2, 1));
  }
  const int deepest = widths.back();
  for (int i = 0; i < kMiddleUnits; ++i) {
    // The first sees the encoder's features, which the decoders share; the others each their own decoder's.
    middle_->push_back(i == 0 ? ShiUnit(deepest, kDecoders * deepest, 1, 1)
                              : ShiUnit(kDecoders * deepest, kDecoders * deepest, 1, kDecoders));
  }
  for (std::size_t i = widths.size(); i-- > 1;)
    decoder_->push_back(ShiUnit((kDecoders + 1) * widths[i], kDecoders * widths[i - 1], 1, 1));
  last_ = ShiUnit((kDecoders + 1) * widths[0], kDecoders * widths[0], 1, 1);
  layers_ = ShiUnit(kDecoders * widths[0], kDecoders * 3, 1, kDecoders);
  register_module("encoder", encoder_);
  register_module("middle", middle_);
  register_module("decoder", decoder_);
  register_module("last", last_);
  register_module("layers", layers_);
}

ShiLayers ShiImpl::forward(const torch::Tensor& x) {
  if (x.dim() != 4 || x.size(1) != 3 || x.size(2) % multiple() != 0 || x.size(3) % multiple() != 0) {
    throw std::invalid_argument("Shi: the input must be N x 3 x H x W with H and W multiples of " +
                                std::to_string(multiple()));
  }
  if (is_training() && x.size(0) * x.size(2) * x.size(3) <= multiple() * multiple())
    throw std::invalid_argument("Shi: one pixel at the smallest size has no variance to train on");
  std::vector<torch::Tensor> seen;
  torch::Tensor features = x;
  for (const auto& unit : *encoder_) seen.push_back(features = run_unit(unit, features));
  for (const auto& unit : *middle_) features = run_unit(unit, features);
  for (const auto& unit : *decoder_) {
    features = grow_2_times(run_unit(unit, torch::cat({features, seen.back()}, 1)));
    seen.pop_back();
  }
  features = last_(torch::cat({features, seen.back()}, 1));
  if (options_.first_stride == 2) features = grow_2_times(features);
  const std::vector<torch::Tensor> layers = layers_(features).chunk(kDecoders, 1);
  return {layers[0], layers[1], layers[2]};
}

}  // namespace faceprobe::net

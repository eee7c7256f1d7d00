#include "net/torch/light_cnn.h"

#include "net/option_reader.h"
#include "net/torch/unet.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace faceprobe::net {
namespace {

constexpr std::array<int, 4> kPanoramaWidths = {32, 24, 16, 16};  // each at twice the size of the last
constexpr int kPanoramaFold = 1 << (kPanoramaWidths.size() - 1);
constexpr double kSmallStart = 0.1;  // of the last layer's weights, where it begins with what is usual

const LightCnnOptions& usable(const LightCnnOptions& options, int light_multiple) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  if (options.light_size % light_multiple != 0) {
    throw std::invalid_argument("light_size is " + std::to_string(options.light_size) + "; it must be a multiple of " +
                                std::to_string(light_multiple) + ".");
  }
  return options;
}

// A panorama with a column more on either side, which is the other side's, and a row more above and below, which repeats its edge.
torch::Tensor wrapped(const torch::Tensor& x) {
  namespace F = torch::nn::functional;
  const torch::Tensor wide = torch::cat({x.narrow(3, x.size(3) - 1, 1), x, x.narrow(3, 0, 1)}, 3);
  return F::pad(wide, F::PadFuncOptions({0, 0, 1, 1}).mode(torch::kReplicate));
}

}  // namespace

std::string LightCnnOptions::validate() const {
  constexpr int kMostPx = 512;
  constexpr std::size_t kMostWidths = 8;
  constexpr int kMost = 512;
  const auto usable_width = [](int width) { return width >= 1 && width <= kMost && width % kNormGroups == 0; };
  if (widths.empty() || widths.size() > kMostWidths || !std::ranges::all_of(widths, usable_width))
    return "widths must list 1 to 8 multiples of 8 up to 512.";
  if (picture_px < 1 || picture_px > kMostPx || picture_px % (1 << widths.size()) != 0)
    return "picture_px is " + std::to_string(picture_px) + "; it must be a multiple of " +
           std::to_string(1 << widths.size()) + " up to 512.";
  if (features < 1 || features > kMost) return "features is " + std::to_string(features) + "; it must lie in 1 to 512.";
  constexpr int kMostLight = 64;
  if (light_size < 1 || light_size > kMostLight)
    return "light_size is " + std::to_string(light_size) + "; it must lie in 1 to 64.";
  return {};
}

std::string options_json(const LightCnnOptions& options) {
  return nlohmann::json({{"picture_px", options.picture_px},
                         {"widths", options.widths},
                         {"features", options.features},
                         {"light_size", options.light_size}})
      .dump();
}

LightCnnOptions light_cnn_options_from_json(const std::string& json) {
  OptionReader reader(json);
  LightCnnOptions options;
  options.picture_px = reader.integer("picture_px");
  options.widths = reader.integers("widths");
  options.features = reader.integer("features");
  options.light_size = reader.integer("light_size");
  reader.finish();
  require_valid_options(options.validate());
  return options;
}

LightEncoderImpl::LightEncoderImpl(const LightCnnOptions& options) : picture_px_(options.picture_px) {
  constexpr int kConvs = 2;  // of a level
  int in = 3;
  for (const int width : options.widths) {
    levels_->push_back(Level(in, width, 2, kConvs));
    in = width;
  }
  const int side = options.picture_px >> options.widths.size();
  features_ = torch::nn::Linear(in * side * side, options.features);
  register_module("levels", levels_);
  register_module("features", features_);
}

torch::Tensor LightEncoderImpl::forward(const torch::Tensor& picture) {
  if (picture.dim() != 4 || picture.size(1) != 3 || picture.size(2) != picture_px_ || picture.size(3) != picture_px_) {
    throw std::invalid_argument("LightEncoder: the input must be N x 3 x " + std::to_string(picture_px_) + " x " +
                                std::to_string(picture_px_));
  }
  torch::Tensor x = 2 * picture - 1;
  for (const auto& level : *levels_) x = level->as<Level>()->forward(x);
  return torch::silu(features_(x.flatten(1)));
}

PanoramaDecoderImpl::PanoramaDecoderImpl(const LightCnnOptions& options, int channels)
    : rows_(options.light_size / kPanoramaFold) {
  start_ = torch::nn::Linear(options.features, kPanoramaWidths[0] * rows_ * 2 * rows_);
  for (std::size_t i = 0; i + 1 < kPanoramaWidths.size(); ++i) {
    convs_->push_back(
        torch::nn::Conv2d(torch::nn::Conv2dOptions(kPanoramaWidths[i], kPanoramaWidths[i + 1], 3).bias(false)));
    norms_->push_back(torch::nn::GroupNorm(torch::nn::GroupNormOptions(kNormGroups, kPanoramaWidths[i + 1])));
  }
  last_ = torch::nn::Conv2d(torch::nn::Conv2dOptions(kPanoramaWidths.back(), channels, 3));
  register_module("start", start_);
  register_module("convs", convs_);
  register_module("norms", norms_);
  register_module("last", last_);
  usual_ = register_parameter("usual", torch::zeros({channels, options.light_size, 2 * options.light_size}));
}

torch::Tensor PanoramaDecoderImpl::forward(const torch::Tensor& features) {
  torch::Tensor x = torch::silu(start_(features)).view({features.size(0), kPanoramaWidths[0], rows_, 2 * rows_});
  for (std::size_t i = 0; i < convs_->size(); ++i) {
    x = torch::upsample_nearest2d(x, {2 * x.size(2), 2 * x.size(3)});
    x = convs_[i]->as<torch::nn::Conv2d>()->forward(wrapped(x));
    x = torch::silu(norms_[i]->as<torch::nn::GroupNorm>()->forward(x));
  }
  return last_(wrapped(x)) + usual_;
}

void PanoramaDecoderImpl::start_at(const torch::Tensor& usual) {
  const torch::NoGradGuard no_grad;
  last_->weight.mul_(kSmallStart);
  last_->bias.zero_();
  usual_.copy_(usual);
}

GardnerNetImpl::GardnerNetImpl(const LightCnnOptions& options)
    : options_(usable(options, kPanoramaFold)), encoder_(options), colour_(options, 3), lights_(options, 1) {
  register_module("encoder", encoder_);
  register_module("colour", colour_);
  register_module("lights", lights_);
  scale_ = register_buffer("scale", torch::ones({1}));
}

Panorama GardnerNetImpl::forward(const torch::Tensor& picture, double drop) {
  const torch::Tensor features = torch::dropout(encoder_(picture), drop, is_training() && drop > 0);
  return {colour_(features), lights_(features)};
}

torch::Tensor GardnerNetImpl::radiance(const torch::Tensor& picture) {
  const Panorama panorama = forward(picture);
  return panorama_radiance({panorama.colour, panorama.lights * scale_});
}

void GardnerNetImpl::set_scale(double scale) {
  const torch::NoGradGuard no_grad;
  scale_.fill_(scale);
}

void GardnerNetImpl::start_at(const Panorama& usual) {
  colour_->start_at(usual.colour);
  lights_->start_at(usual.lights);
}

torch::Tensor panorama_radiance(const Panorama& panorama) {
  constexpr double kDarkest = 1e-3;  // of white, encoded: 2e-7 of its light
  return panorama.colour.clamp(kDarkest, 1).pow(LightCnnOptions::kGamma) *
         panorama.lights.clamp(0, LightCnnOptions::kLargestLog).exp();
}

Panorama panorama_of(const torch::Tensor& radiance) {
  const torch::Tensor above = radiance.amax(1, true).clamp_min(1);
  return {(radiance / above).clamp(0, 1).pow(1 / LightCnnOptions::kGamma),
          above.log().clamp_max(LightCnnOptions::kLargestLog)};
}

LegendreNetImpl::LegendreNetImpl(const LightCnnOptions& options)
    : options_(usable(options, 1)), encoder_(options),
      light_(options.features, 3 * 12 * options.light_size * options.light_size) {
  register_module("encoder", encoder_);
  register_module("light", light_);
}

torch::Tensor LegendreNetImpl::forward(const torch::Tensor& picture, double drop) {
  const torch::Tensor features = torch::dropout(encoder_(picture), drop, is_training() && drop > 0);
  return light_(features).view({picture.size(0), -1, 3}).clamp(-LightCnnOptions::kLargestLog, LightCnnOptions::kLargestLog);
}

void LegendreNetImpl::start_at(const torch::Tensor& usual) {
  const torch::NoGradGuard no_grad;
  light_->weight.mul_(kSmallStart);
  light_->bias.copy_(usual.reshape({-1}));
}

}  // namespace faceprobe::net

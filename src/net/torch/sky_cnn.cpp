#include "net/torch/sky_cnn.h"

#include "faceprobe/core/sun_bins.h"
#include "net/option_reader.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::net {
namespace {

constexpr std::array<int, SkyCnnOptions::kConvolutions> kSides = {7, 5, 3, 3, 3, 3, 3};
constexpr std::array<int, SkyCnnOptions::kConvolutions> kStrides = {2, 2, 2, 1, 2, 1, 2};
constexpr double kLeastSpread = 1e-3;  // of numbers that do not change

}  // namespace

std::string SkyCnnOptions::validate() const {
  constexpr int kMostPx = 512;
  constexpr int kMostChannels = 2048;
  if (px < kShrinks || px > kMostPx || px % kShrinks != 0)
    return "px is " + std::to_string(px) + "; it must be a multiple of 32 in 32 to 512.";
  const auto usable = [](int size) { return size >= 1 && size <= kMostChannels; };
  if (static_cast<int>(widths.size()) != kConvolutions || !std::ranges::all_of(widths, usable))
    return "widths must list 7 sizes of 1 to 2048.";
  if (!usable(hidden)) return "hidden is " + std::to_string(hidden) + "; it must lie in 1 to 2048.";
  return {};
}

std::string options_json(const SkyCnnOptions& options) {
  return nlohmann::json({{"px", options.px}, {"widths", options.widths}, {"hidden", options.hidden}}).dump();
}

SkyCnnOptions sky_cnn_options_from_json(const std::string& json) {
  OptionReader reader(json);
  SkyCnnOptions options;
  options.px = reader.integer("px");
  options.widths = reader.integers("widths");
  options.hidden = reader.integer("hidden");
  reader.finish();
  require_valid_options(options.validate());
  return options;
}

SkyCnnImpl::SkyCnnImpl(const SkyCnnOptions& options) : options_(options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  mean_ = register_buffer("mean", torch::zeros({kSkyNumbers}));
  spread_ = register_buffer("spread", torch::ones({kSkyNumbers}));
  ground_ = register_buffer("ground", torch::zeros({1}));
  int in = 3;
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    const int out = options.widths[i];
    // The normalisation has the bias.
    const auto shape =
        torch::nn::Conv2dOptions(in, out, kSides[i]).stride(kStrides[i]).padding(kSides[i] / 2).bias(false);
    convolutions_.emplace_back(register_module("conv" + std::to_string(i), torch::nn::Conv2d(shape)));
    norms_.emplace_back(register_module("norm" + std::to_string(i), BatchNorm(out)));
    in = out;
  }
  const int side = options.px / SkyCnnOptions::kShrinks;
  all_ =
      register_module("all", torch::nn::Linear(torch::nn::LinearOptions(in * side * side, options.hidden).bias(false)));
  norms_.emplace_back(register_module("norm_all", BatchNorm(options.hidden)));
  sun_ = register_module("sun", torch::nn::Linear(options.hidden, kSunBins));
  numbers_ = register_module("numbers", torch::nn::Linear(options.hidden, kSkyNumbers));
}

void SkyCnnImpl::standardise(const torch::Tensor& examples, double ground_albedo) {
  const torch::NoGradGuard no_grad;
  mean_.copy_(examples.mean(0));
  spread_.copy_(examples.std(0, false) + kLeastSpread);
  ground_.fill_(ground_albedo);
}

SkyCnnImpl::Output SkyCnnImpl::forward(const torch::Tensor& pictures, double drop) {
  torch::Tensor x = pictures - 0.5;
  for (std::size_t i = 0; i < convolutions_.size(); ++i)
    x = torch::elu(norms_[i]->forward(convolutions_[i]->forward(x)));
  x = torch::elu(norms_.back()->forward(all_->forward(x.flatten(1))));
  x = torch::dropout(x, drop, is_training() && drop > 0);
  return {sun_->forward(x), numbers_->forward(x)};
}

}  // namespace faceprobe::net

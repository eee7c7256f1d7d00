#include "net/torch/mscr.h"

#include "net/option_reader.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using torch::nn::Conv2dOptions;

constexpr double kUsual = 0.01, kSmall = 0.001;  // standard deviations of the Gaussian fillings
constexpr int kGrow = 8;
constexpr int kFilter = 2 * kGrow;

// Caffe rounds the size up.
torch::Tensor pool(const torch::Tensor& x) { return torch::max_pool2d(x, {3, 3}, {2, 2}, {0, 0}, {1, 1}, true); }

torch::Tensor normalise(const torch::Tensor& x) {
  namespace F = torch::nn::functional;
  return F::local_response_norm(x, F::LocalResponseNormFuncOptions(5).alpha(1e-4).beta(0.75).k(1));
}

// 8n x n: what a row of n pixels becomes, with the filter's taps in its columns.
torch::Tensor growth(const torch::Tensor& taps, std::int64_t n) {
  torch::Tensor matrix = torch::zeros({kGrow * n + kFilter, n}, taps.options());
  for (std::int64_t i = 0; i < n; ++i) matrix.select(1, i).narrow(0, kGrow * i, kFilter).copy_(taps);
  return matrix.narrow(0, kGrow / 2, kGrow * n);
}

// As the module's forward(), whose way back is slow on a processor.
torch::Tensor prelu(torch::nn::PReLU& slope, const torch::Tensor& x) {
  return torch::relu(x) - slope->weight.view({1, -1, 1, 1}) * torch::relu(-x);
}

torch::Tensor drop(const torch::Tensor& x, bool training) { return torch::dropout(x, 0.5, training); }

}  // namespace

std::string MscrOptions::validate() const {
  for (const float channel : mean) {
    if (!(std::abs(channel) <= 1))
      return "mean is " + std::to_string(channel) + " in a channel; it must lie in -1 to 1.";
  }
  return {};
}

std::string options_json(const MscrOptions& options) { return nlohmann::json{{"mean", options.mean}}.dump(); }

MscrOptions mscr_options_from_json(const std::string& text) {
  OptionReader reader(text);
  const std::vector<float> mean = reader.numbers("mean");
  reader.finish();
  require_valid_options(mean.size() == 3 ? "" : "mean has " + std::to_string(mean.size()) + " numbers; 3 are wanted.");
  const MscrOptions options{{mean[0], mean[1], mean[2]}};
  require_valid_options(options.validate());
  return options;
}

torch::Tensor mscr_input(const torch::Tensor& linear, const MscrOptions& options) {
  const torch::Tensor mean = torch::tensor({options.mean[0], options.mean[1], options.mean[2]}, linear.options());
  return linear.clamp(0, 1) - mean.view({1, 3, 1, 1});
}

torch::Tensor bilinear_filter() {
  // A triangle whose taps, 8 pixels apart, sum to 1 at every phase.
  const torch::Tensor at = torch::arange(kFilter, torch::kFloat32);
  const torch::Tensor triangle = 1 - ((at - (kFilter - 1) / 2.0) / kGrow).abs();
  return torch::outer(triangle, triangle).view({1, 1, kFilter, kFilter});
}

torch::Tensor grow_8_times(const torch::Tensor& x, const torch::Tensor& filter) {
  // A transposed convolution of one channel by itself is slow in libtorch; the filter is an outer product, and its taps sum to kGrow.
  const torch::Tensor taps = filter.detach().view({kFilter, kFilter}).sum(1) / kGrow;
  const torch::Tensor wide = torch::matmul(x, growth(taps, x.size(3)).t());
  return torch::matmul(growth(taps, x.size(2)), wide);
}

torch::nn::Conv2d MscrTrunk::add_conv(const std::string& name, const Conv2dOptions& conv, double deviation, double bias) {
  torch::nn::Conv2d layer = register_module(name, torch::nn::Conv2d(conv));
  torch::nn::init::normal_(layer->weight, 0, deviation);
  torch::nn::init::constant_(layer->bias, bias);
  return layer;
}

MscrTrunk::Unit MscrTrunk::add_unit(const std::string& name, const Conv2dOptions& conv, double deviation) {
  const auto slopes = torch::nn::PReLUOptions().num_parameters(conv.out_channels()).init(0.25);
  return {add_conv(name, conv, deviation, 0), register_module(name + "_prelu", torch::nn::PReLU(slopes))};
}

// As many smaller terms or fewer larger ones: their sums have the same spread.
double MscrTrunk::usual_deviation() const { return kUsual * std::sqrt(static_cast<double>(divisor_)); }

MscrTrunk::MscrTrunk(int divisor) : divisor_(divisor) {
  const auto c = [this](int released) { return channels(released); };
  const double usual = usual_deviation();
  conv1_ = add_conv("conv1", Conv2dOptions(3, c(96), 11).stride(4).padding(5), kUsual, 0);
  conv2_ = add_conv("conv2", Conv2dOptions(c(96), c(256), 5).padding(2).groups(2), usual, 1);
  conv3_ = add_conv("conv3", Conv2dOptions(c(256), c(384), 3).padding(1), usual, 0);
  conv4_ = add_conv("conv4", Conv2dOptions(c(384), c(384), 3).padding(1).groups(2), usual, 0);
  conv5_ = add_conv("conv5", Conv2dOptions(c(384), c(256), 3).padding(1).groups(2), usual, 1);
  filter_ = register_buffer("conv5_upsample", bilinear_filter());
  coarse_out_ = add_unit("s1_out", Conv2dOptions(c(256), c(64), 1), usual);
  first_ = add_unit("s2_1", Conv2dOptions(3, c(96), 9).stride(2).padding(4), kSmall);
  for (std::size_t i = 0; i < fine_.size(); ++i) {
    const int in = i == 0 ? c(96) + c(64) : c(64);
    fine_[i] = add_unit("s2_" + std::to_string(i + 2), Conv2dOptions(in, c(64), 5).padding(2), usual);
  }
}

MscrTrunk::Branch MscrTrunk::add_branch(const std::string& unit, const std::string& up) {
  const int width = channels(64);
  Branch branch{add_unit(unit, Conv2dOptions(width, width, 5).padding(2), usual_deviation()), nullptr};
  branch.up = register_module(
      up, torch::nn::ConvTranspose2d(torch::nn::ConvTranspose2dOptions(width, 3, 8).stride(4).padding(2)));
  torch::nn::init::normal_(branch.up->weight, 0, kSmall);
  torch::nn::init::constant_(branch.up->bias, 0);
  return branch;
}

torch::Tensor MscrTrunk::coarse(const torch::Tensor& x) {
  torch::Tensor features = normalise(pool(torch::relu(conv1_(x))));
  features = normalise(pool(torch::relu(conv2_(features))));
  features = torch::relu(conv3_(features));
  features = torch::relu(conv4_(features));
  features = grow_8_times(pool(torch::relu(conv5_(features))), filter_);
  return drop(prelu(coarse_out_.slope, coarse_out_.conv(features)), is_training());
}

torch::Tensor MscrTrunk::features(const torch::Tensor& x) {
  if (x.dim() != 4 || x.size(1) != 3 || x.size(2) % kMscrMultiple != 0 || x.size(3) % kMscrMultiple != 0) {
    throw std::invalid_argument("MSCR: the input must be N x 3 x H x W with H and W multiples of 32");
  }
  torch::Tensor features = torch::cat({pool(prelu(first_.slope, first_.conv(x))), coarse(x)}, 1);
  for (Unit& unit : fine_) features = drop(prelu(unit.slope, unit.conv(features)), is_training());
  return features;
}

torch::Tensor MscrTrunk::run(Branch& branch, const torch::Tensor& features) {
  return branch.up(drop(prelu(branch.unit.slope, branch.unit.conv(features)), is_training()));
}

MscrImpl::MscrImpl(const MscrOptions& options) : MscrTrunk(1), options_(options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  highlight_ = add_branch("s2_5", "up");
}

torch::Tensor MscrImpl::forward(const torch::Tensor& x) { return run(highlight_, features(x)); }

}  // namespace faceprobe::net

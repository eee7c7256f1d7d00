#pragma once
// The network of the sky regressor (faceprobe/net/sky_regressor.h runs it): from a square picture to where the sun stands and to a few numbers of
// sky and camera. Seven convolutions with batch normalisation and ELU, a layer of all of it, two heads, after Hold-Geoffroy et al. 2017, in small.
//
//   SkyCnn net(SkyCnnOptions{});
//   const SkyCnn::Impl::Output out = net(pictures);       // N x 3 x px x px, sRGB-encoded, 0..1
//   const torch::Tensor share = out.sun.softmax(1);       // N x 160, core/sun_bins.h

#include "net/torch/batch_norm.h"

#include <torch/torch.h>
#include <string>
#include <vector>

namespace faceprobe::net {

struct SkyCnnOptions {
  static constexpr int kConvolutions = 7;
  static constexpr int kShrinks = 32;  // by which the convolutions make a picture smaller

  int px = 96;                                             // side of the picture, a multiple of kShrinks
  std::vector<int> widths = {24, 40, 64, 64, 96, 96, 96};  // channels after each convolution
  int hidden = 256;

  std::string validate() const;  // empty when usable, else which value is wrong
};

std::string options_json(const SkyCnnOptions& options);
// Throws Error(kModel).
SkyCnnOptions sky_cnn_options_from_json(const std::string& json);

// The numbers of the second head, in their order.
enum class SkyNumber : int {
  kTurbidity,
  kLogExposure,      // of the radiance for 1000 cd/m2 where 1 is the picture's white
  kCameraElevation,  // radians, positive where the camera looks up
  kFieldOfView,      // radians
  kLogSunlight,  // of kLeastSunlight + what the sun sends onto a surface that faces it, luminance x steradian on that scale
};
inline constexpr int kSkyNumbers = 5;
inline constexpr double kLeastSunlight = 0.01;

class SkyCnnImpl : public torch::nn::Module {
 public:
  struct Output {
    torch::Tensor sun;      // N x kSunBins, logits
    torch::Tensor numbers;  // N x kSkyNumbers, as standardised
  };

  // Throws std::invalid_argument for options that do not validate.
  explicit SkyCnnImpl(const SkyCnnOptions& options);

  // What the numbers are like, from N x kSkyNumbers examples, and the ground below the sky.
  void standardise(const torch::Tensor& examples, double ground_albedo);
  // Numbers to mean 0 and unit spread, and back.
  torch::Tensor standardised(const torch::Tensor& numbers) const { return (numbers - mean_) / spread_; }
  torch::Tensor restored(const torch::Tensor& numbers) const { return numbers * spread_ + mean_; }
  double ground_albedo() const { return ground_.item<double>(); }

  // `drop`: share of the hidden units left out while training.
  Output forward(const torch::Tensor& pictures, double drop = 0);

  const SkyCnnOptions& options() const { return options_; }

 private:
  SkyCnnOptions options_;
  torch::Tensor mean_, spread_, ground_;
  std::vector<torch::nn::Conv2d> convolutions_;
  std::vector<BatchNorm> norms_;  // after each convolution and after the layer of all
  torch::nn::Linear all_ = nullptr, sun_ = nullptr, numbers_ = nullptr;
};
TORCH_MODULE(SkyCnn);

}  // namespace faceprobe::net

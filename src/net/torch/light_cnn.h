#pragma once
// The two networks of light_regressor.h: one encoder, a picture into a list of numbers, and what either makes of it.
//
//   GardnerNet net(LightCnnOptions{});
//   const torch::Tensor light = net->radiance(picture);         // N x 3 x px x px, sRGB 0 .. 1 -> N x 3 x height x 2 height
//
//   LegendreNet net(LightCnnOptions{.light_size = 8});
//   const torch::Tensor light = net->forward(picture).exp();    // -> N x cells x 3

#include <torch/torch.h>
#include <string>
#include <vector>

namespace faceprobe::net {

struct LightCnnOptions {
  int picture_px = 96;                             // a multiple of 2 to the number of widths
  std::vector<int> widths = {16, 32, 48, 64, 96};  // of the encoder, each at half the size of the last
  int features = 160;                              // what it makes of a picture
  int light_size = 32;  // Gardner's: height of the panorama, a multiple of 8; LeGendre's: nside of the grid

  static constexpr float kLargestLog = 9;  // of radiance, either sign
  static constexpr float kGamma = 2.2F;    // of a panorama's colours

  std::string validate() const;  // empty when usable
};
std::string options_json(const LightCnnOptions& options);
// Throws Error(kModel).
LightCnnOptions light_cnn_options_from_json(const std::string& json);

// Convolutions with group norm that halve the size, then one layer of sums. N x 3 x px x px, sRGB 0 .. 1 -> N x features.
class LightEncoderImpl : public torch::nn::Module {
 public:
  explicit LightEncoderImpl(const LightCnnOptions& options);
  torch::Tensor forward(const torch::Tensor& picture);

 private:
  int picture_px_;
  torch::nn::ModuleList levels_;
  torch::nn::Linear features_{nullptr};
};
TORCH_MODULE(LightEncoder);

// Numbers into a panorama, which goes on beyond its left and right sides.
class PanoramaDecoderImpl : public torch::nn::Module {
 public:
  PanoramaDecoderImpl(const LightCnnOptions& options, int channels);
  torch::Tensor forward(const torch::Tensor& features);
  // The last layer begins with `usual` (channels x height x 2 height), whatever the picture.
  void start_at(const torch::Tensor& usual);

 private:
  int rows_;  // of the coarsest panorama
  torch::nn::Linear start_{nullptr};
  torch::nn::ModuleList convs_, norms_;
  torch::nn::Conv2d last_{nullptr};
  torch::Tensor usual_;
};
TORCH_MODULE(PanoramaDecoder);

struct Panorama {
  torch::Tensor colour;  // N x 3 x H x 2H: radiance to the power 1 / gamma, its lights brought down to white
  torch::Tensor lights;  // N x 1 x H x 2H: natural logarithm of what they are above white, 0 elsewhere; while the mask is learnt, 0 and 1
};

class GardnerNetImpl : public torch::nn::Module {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit GardnerNetImpl(const LightCnnOptions& options);
  Panorama forward(const torch::Tensor& picture, double drop = 0);
  torch::Tensor radiance(const torch::Tensor& picture);  // N x 3 x H x 2H
  void start_at(const Panorama& usual);                  // without N
  // What the lights' logarithms are multiplied by for their radiance: where it is unsure the network says a mean of logarithms, which is dim.
  void set_scale(double scale);
  const LightCnnOptions& options() const { return options_; }

 private:
  LightCnnOptions options_;
  LightEncoder encoder_;
  PanoramaDecoder colour_, lights_;
  torch::Tensor scale_;
};
TORCH_MODULE(GardnerNet);

// Radiance N x 3 x H x 2H of a panorama, and back.
torch::Tensor panorama_radiance(const Panorama& panorama);
Panorama panorama_of(const torch::Tensor& radiance);

class LegendreNetImpl : public torch::nn::Module {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit LegendreNetImpl(const LightCnnOptions& options);
  // Natural logarithm of radiance, N x cells x 3.
  torch::Tensor forward(const torch::Tensor& picture, double drop = 0);
  void start_at(const torch::Tensor& usual);  // cells x 3
  const LightCnnOptions& options() const { return options_; }

 private:
  LightCnnOptions options_;
  LightEncoder encoder_;
  torch::nn::Linear light_{nullptr};
};
TORCH_MODULE(LegendreNet);

}  // namespace faceprobe::net

#pragma once
// The network of the paper: MSCR of Narihira, Maire & Yu 2015, "Direct Intrinsics" (ICCV), with one output branch of three
// channels for the highlight layer. For comparing with the paper; unet.h is faster and sharper.
//
// Layers, fillings and Caffe's habits (pooling rounds up, per-channel PReLU from 0.25) follow the released train_val.prototxt of
// tnarihi/direct-intrinsics, see section 1.1 of the reference notes. Scale 1 is CaffeNet's conv1 to conv5, shrunk 32 times and
// grown back to a quarter; scale 2 works at a quarter of the size; a transposed convolution ends at the full size.
//
//   Mscr net(MscrOptions{});
//   net->eval();                                        // else dropout is at work
//   torch::Tensor out = net(mscr_input(linear, net->options()));   // N x 3 x H x W -> the same size; H, W multiples of 32

#include <torch/torch.h>
#include <array>
#include <string>

namespace faceprobe::net {

struct MscrOptions {
  // Subtracted from the input, linear light. Default: the mean of ImageNet that Caffe subtracts, (123, 117, 104) of 255, as light.
  std::array<float, 3> mean = {0.198F, 0.178F, 0.138F};

  std::string validate() const;
  bool operator==(const MscrOptions&) const = default;
};
std::string options_json(const MscrOptions& options);
// Throws Error(kModel).
MscrOptions mscr_options_from_json(const std::string& text);

constexpr int kMscrMultiple = 32;
constexpr int kMostMscrDivisor = 16;  // powers of two up to it divide every layer and group

// `linear`: N x 3 x H x W. Light clamped to 0 to 1, less the mean.
torch::Tensor mscr_input(const torch::Tensor& linear, const MscrOptions& options);

// 1 x 1 x 16 x 16: Caffe's filter for growing 8 times by linear interpolation.
torch::Tensor bilinear_filter();
// N x C x h x w -> N x C x 8h x 8w with that filter, every channel by itself. Beyond its edge the picture is taken as 0.
torch::Tensor grow_8_times(const torch::Tensor& x, const torch::Tensor& filter);

// All of it before the outputs' own layers; on these stand MSCR and, with two branches, albedo_shading.h.
class MscrTrunk : public torch::nn::Module {
 protected:
  // A convolution with its PReLU.
  struct Unit {
    torch::nn::Conv2d conv{nullptr};
    torch::nn::PReLU slope{nullptr};
  };
  // One output: a unit, and a transposed convolution to three channels at the full size.
  struct Branch {
    Unit unit;
    torch::nn::ConvTranspose2d up{nullptr};
  };

  // `divisor`: of every number of channels but the picture's; 1 = as released, at most kMostMscrDivisor.
  explicit MscrTrunk(int divisor);
  // Registers them under these names.
  Branch add_branch(const std::string& unit, const std::string& up);
  // N x 3 x H x W -> N x 64 x H/4 x W/4. Throws std::invalid_argument for another number of channels or a size that is no multiple of 32.
  torch::Tensor features(const torch::Tensor& x);
  // Those features to N x 3 x H x W.
  torch::Tensor run(Branch& branch, const torch::Tensor& features);

 private:
  int channels(int released) const { return released / divisor_; }
  double usual_deviation() const;
  torch::nn::Conv2d add_conv(const std::string& name, const torch::nn::Conv2dOptions& conv, double deviation,
                             double bias);
  Unit add_unit(const std::string& name, const torch::nn::Conv2dOptions& conv, double deviation);
  torch::Tensor coarse(const torch::Tensor& x);

  int divisor_;
  torch::nn::Conv2d conv1_{nullptr}, conv2_{nullptr}, conv3_{nullptr}, conv4_{nullptr}, conv5_{nullptr};
  torch::Tensor filter_;
  Unit coarse_out_, first_;
  std::array<Unit, 3> fine_;
};

class MscrImpl : public MscrTrunk {
 public:
  // Throws std::invalid_argument for options that do not validate.
  explicit MscrImpl(const MscrOptions& options);
  // Throws std::invalid_argument as the trunk's features() do.
  torch::Tensor forward(const torch::Tensor& x);

  const MscrOptions& options() const { return options_; }

 private:
  MscrOptions options_;
  Branch highlight_;
};
TORCH_MODULE(Mscr);

}  // namespace faceprobe::net

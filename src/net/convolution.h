#pragma once
// One convolution of a trained network, by oneDNN. Features are an Image: height x width x channels, interleaved.
//
//   const Convolution conv(weights, "head", {.in = 24, .out = 16, .kernel = 3, .bias = true});
//   const Image out = conv(features);

#include "faceprobe/core/image.h"
#include "net/weight_list.h"

#include <memory>
#include <string>

namespace faceprobe::net {

struct ConvolutionShape {
  int in = 1, out = 1;
  int kernel = 3;  // square; padded by kernel / 2 zeros
  int stride = 1;
  bool bias = false;
};

class Convolution {
 public:
  // `name`.weight (out x in x kernel x kernel) and `name`.bias (out). Throws Error(kModel): missing, or of another shape.
  Convolution(WeightList& weights, const std::string& name, const ConvolutionShape& shape);
  Convolution(const Convolution&) = delete;
  Convolution& operator=(const Convolution&) = delete;
  Convolution(Convolution&&) noexcept;
  Convolution& operator=(Convolution&&) noexcept;
  ~Convolution();

  // H x W x in -> ceil(H / stride) x ceil(W / stride) x out. May be called from several threads.
  Image operator()(const Image& features) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace faceprobe::net

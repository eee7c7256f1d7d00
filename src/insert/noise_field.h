#pragma once
// White noise that went through a discrete Gaussian, over a part of a picture. Each pixel's number depends on its place, the seed
// and the purpose alone, not on which part is made.
//
//   const NoiseField field({.left = 10, .top = 10, .right = 90, .bottom = 60}, 0.8F, 1, seed, 0);
//   const float value = field(20, 30, 0);                              // mean 0, variance 1

#include "faceprobe/core/image.h"
#include "faceprobe/core/pixel_box.h"

#include <cstdint>

namespace faceprobe::insert {

// Memory and time grow with the box.
class NoiseField {
 public:
  NoiseField(const PixelBox& box, float correlation_px, int channels, std::uint64_t seed, std::uint64_t purpose);
  // A pixel of the box, by its place in the picture.
  float operator()(int x, int y, int channel) const {
    return gain_ * noise_(x - box_.left + margin_, y - box_.top + margin_, channel);
  }

 private:
  PixelBox box_;
  int margin_ = 0;
  float gain_ = 1;
  Image noise_;
};

}  // namespace faceprobe::insert

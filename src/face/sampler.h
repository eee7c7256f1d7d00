#pragma once
// Square, possibly turned pieces of a photo, resampled and sRGB-encoded as the networks were trained to see them. Keeps
// halved copies of the photo so that a small sample of a large region is an average, not a selection.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::face {

// A square of the photo, px; `angle` turns its x axis clockwise on the screen (y down), radians.
struct SquareRegion {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  float side = 0;
  float angle = 0;

  // (u, v) in [0, 1]^2 of the square, from its own top left corner, to the photo.
  Eigen::Vector2f photo_from_unit(float u, float v) const;
};

class Sampler {
 public:
  // `linear` has 1 or 3 channels and must outlive the sampler.
  explicit Sampler(const Image& linear);

  int width() const { return photo_->width(); }
  int height() const { return photo_->height(); }
  // From here on light is multiplied so that the photo, or the square, is neither black nor burnt out. A photo that is
  // well exposed stays as it is.
  void expose() {
    expose({{0.5F * static_cast<float>(width()), 0.5F * static_cast<float>(height())},
            static_cast<float>(width() > height() ? width() : height()),
            0});
  }
  void expose(const SquareRegion& region);

  // size * size * 3 encoded values in [low, high], black outside the photo, row-major into `out`.
  void sample(const SquareRegion& region, int size, float low, float high, float* out) const;

 private:
  Image warp(const SquareRegion& region, int size) const;

  const Image* photo_;
  std::vector<Image> halved_;  // number i is halved i + 1 times
  float gain_ = 1;             // of light, before it is encoded
};

}  // namespace faceprobe::face

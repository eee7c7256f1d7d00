#pragma once
// The joint bilateral filter for very large spatial windows, on a coarse (x, y, guide) grid: values are spread into the
// grid, the grid is blurred, and the result is read back by interpolation (Paris & Durand, IJCV 81, 2009). Normalised
// by the blurred count of values, so pixels outside the mask take no part. Cost per pixel does not depend on the
// window.

#include "faceprobe/core/image.h"

#include <vector>

namespace faceprobe::highlight {

struct BilateralSigmas {
  float spatial;  // pixels
  float range;    // units of the guide
};

class BilateralGrid {
 public:
  // guide: H x W x 1 with values in [0, 1]; values below zero mark the pixels that take no part. The guide must outlive
  // this.
  BilateralGrid(const Image& guide, const BilateralSigmas& sigmas, int threads);

  // H x W x 1; 0 where the guide is below zero.
  Image filter(const Image& values) const;

 private:
  struct Axis {
    int cells = 1;
    float per_unit = 0;  // cells per pixel, or per unit of the guide
  };
  // One value per cell of a fixed (x, guide) plane, y by y.
  using Cells = std::vector<float>;

  template <class ValueAt>
  Cells spread(const ValueAt& value_at) const;
  void blur(Cells* cells) const;
  std::size_t plane_size() const { return static_cast<std::size_t>(x_.cells) * static_cast<std::size_t>(z_.cells); }

  const Image& guide_;
  Axis x_, y_, z_;
  float guide_low_ = 0;
  int threads_;
  Cells weights_;  // blurred count
};

}  // namespace faceprobe::highlight

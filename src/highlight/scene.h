#pragma once
// What every separator reads: the picture as it would look under white light, pixel by pixel and without a copy, and
// where to look. Each separator answers with one plane: how much white light each pixel mirrors (before the cap by the
// picture).

#include "faceprobe/core/image.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace faceprobe::highlight {

// A colour reduced to what a white highlight s changes in a known way: s, s and 3 s are added to these three.
struct Extremes {
  float low;    // smallest channel
  float high;   // largest channel
  float total;  // sum of the channels
};

struct Scene {
  const Image& linear;
  const ByteImage& mask;       // empty = everywhere
  std::array<float, 3> gains;  // 1 / light colour, the light scaled to mean 1
  int threads;

  int width() const { return linear.width(); }
  int height() const { return linear.height(); }
  bool inside(int x, int y) const { return mask.empty() || mask(x, y) != 0; }

  // Negative and non-finite values count as black: no light there that could be split.
  std::array<float, 3> colour(int x, int y) const {
    const float* value = linear.pixel(x, y);
    std::array<float, 3> out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = value[c] > 0 && value[c] < kTooBright ? value[c] * gains[c] : 0.0F;
    return out;
  }
  Extremes extremes(int x, int y) const {
    const std::array<float, 3> rgb = colour(x, y);
    return {std::min({rgb[0], rgb[1], rgb[2]}), std::max({rgb[0], rgb[1], rgb[2]}), rgb[0] + rgb[1] + rgb[2]};
  }

 private:
  static constexpr float kTooBright = 1e30F;  // sums of three stay finite below it
};

// Below this share of the largest channel a colour is grey: rounding of the white balance alone makes as much.
inline constexpr float kGreyShare = 1e-4F;
inline bool is_grey(const Extremes& e) { return e.high - e.low <= kGreyShare * e.high; }

// Three times the largest chromaticity, less one: 0 for grey, 2 for a pure primary. White light lowers it, and in a
// known way: total * saturation stays.
inline float saturation(const Extremes& e) { return 3 * (e.high / e.total) - 1; }

// The white light that lowered the saturation of a colour from `diffuse` to what it is.
inline float white_part(const Extremes& e, float diffuse) {
  return std::max(0.0F, e.total * (1 - saturation(e) / diffuse) / 3);
}

// H x W x 1, >= 0, 0 outside the mask.
Image tan_highlight(const Scene& scene);
Image yang_highlight(const Scene& scene);
Image shen_highlight(const Scene& scene);

}  // namespace faceprobe::highlight

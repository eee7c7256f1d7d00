#pragma once
// Internal: atan2 for loops that run eight at a time. Abramowitz & Stegun 1964, 4.4.47; off by at most 1.2e-5 radians, which is a
// thousandth of a texel of a map 512 wide.

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {

// atan2(y, x), 0 at the origin.
inline float fast_atan2(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float small = std::min(ax, ay);
  const float large = std::max(std::max(ax, ay), 1e-30F);
  const float r = small / large;
  const float r2 = r * r;
  float angle = r * (0.9998660F + r2 * (-0.3302995F + r2 * (0.1801410F + r2 * (-0.0851330F + r2 * 0.0208351F))));
  angle = ay > ax ? static_cast<float>(kPi / 2) - angle : angle;
  angle = x < 0.0F ? static_cast<float>(kPi) - angle : angle;
  return std::copysign(angle, y);
}

}  // namespace faceprobe::synth

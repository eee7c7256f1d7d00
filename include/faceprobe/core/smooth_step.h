#pragma once
// A step without a corner: 0 up to `from`, 1 from `to` on, and a cubic between them whose slope is 0 at both ends. Where `from` is the
// larger of the two it falls from 1 to 0.
//
//   const float facing = smooth_step(0.3F, 0.7F, normal.dot(view));

#include <algorithm>

namespace faceprobe {

// `from` != `to`.
inline float smooth_step(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

}  // namespace faceprobe

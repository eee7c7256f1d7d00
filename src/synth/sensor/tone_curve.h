#pragma once
// Internal: what a camera makes of exposed light: a shoulder, the sRGB curve and an S on top of it. Monotone, 0 -> 0, 1 -> 1.

#include <array>
#include <cstddef>

namespace faceprobe::synth {

// The exact curve, x in [0, 1].
float tone_curve(float x, float shoulder, float contrast);

// The same from a table, off by less than 1e-4.
class ToneTable {
 public:
  ToneTable(float shoulder, float contrast);
  // In place: exposed light in, code values 0 .. 255 out, not rounded. What is over white is white, NaN is black.
  void encode(float* values, std::size_t count) const;

 private:
  // Even steps of the light's square root: the curve has no steep place there.
  static constexpr int kSteps = 1024;
  std::array<float, kSteps + 2> codes_{};
};

}  // namespace faceprobe::synth

#include "synth/sensor/tone_curve.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Straight up to a knee, then a parabola that reaches white with a lower slope. The straight part is steeper than 1 to make up.
struct Shoulder {
  explicit Shoulder(float strength) {
    knee = 0.8F - 0.4F * strength;
    end_slope = 1.0F - 0.9F * strength;
    slope = (1.0F - 0.5F * (1.0F - knee) * end_slope) / (0.5F * (1.0F + knee));
  }
  float operator()(float x) const {
    const float over = std::max(0.0F, x - knee);
    return slope * x - 0.5F * (slope - end_slope) / (1.0F - knee) * over * over;
  }
  float knee, end_slope, slope;
};

// A sine has the S of film about middle grey and leaves black and white alone; monotone for amounts within +-1.
float with_contrast(float code, float contrast) {
  const auto turn = static_cast<float>(2.0 * kPi);
  return code - 0.5F * contrast * std::sin(turn * code) / turn;
}

}  // namespace

float tone_curve(float x, float shoulder, float contrast) {
  return with_contrast(srgb_from_linear(Shoulder(shoulder)(x)), contrast);
}

ToneTable::ToneTable(float shoulder, float contrast) {
  for (std::size_t i = 0; i < codes_.size(); ++i) {
    const float root = std::min(1.0F, static_cast<float>(i) / static_cast<float>(kSteps));
    codes_[i] = 255.0F * tone_curve(root * root, shoulder, contrast);
  }
}

void ToneTable::encode(float* values, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    const float light = values[i] > 0.0F ? values[i] : 0.0F;
    values[i] = static_cast<float>(kSteps) * std::sqrt(std::min(light, 1.0F));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = static_cast<int>(values[i]);
    const float* code = codes_.data() + step;
    values[i] = code[0] + (values[i] - static_cast<float>(step)) * (code[1] - code[0]);
  }
}

}  // namespace faceprobe::synth

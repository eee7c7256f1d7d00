#include "synth/sensor/tone_curve.h"

#include "faceprobe/core/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace faceprobe::synth {
namespace {

TEST(ToneCurve, PlainIsSrgb) {
  for (int i = 0; i <= 1000; ++i) {
    const float x = static_cast<float>(i) / 1000.0F;
    EXPECT_NEAR(tone_curve(x, 0, 0), srgb_from_linear(x), 1e-6F);
  }
}

TEST(ToneCurve, IsMonotoneFromBlackToWhite) {
  for (const float shoulder : {0.0F, 0.3F, 1.0F}) {
    for (const float contrast : {-1.0F, -0.4F, 0.0F, 0.5F, 1.0F}) {
      EXPECT_NEAR(tone_curve(0, shoulder, contrast), 0, 1e-6F);
      EXPECT_NEAR(tone_curve(1, shoulder, contrast), 1, 2e-6F);
      float last = -1;
      for (int i = 0; i <= 2000; ++i) {
        const float code = tone_curve(static_cast<float>(i) / 2000.0F, shoulder, contrast);
        EXPECT_GT(code, last);  // strictly: the lowest slope is .1 * .5 of sRGB's
        last = code;
      }
    }
  }
}

// Measured responses (Grossberg & Nayar 2004, "Modeling the space of camera response functions") bend both ways from a gamma
// curve. The family is to reach visibly to both sides of sRGB's at half of white, and nowhere from deep shadow to
// white by more than a stop and a quarter, which would look like a wrong exposure.
TEST(ToneCurve, SpansPlausibleCameras) {
  for (const float x : {0.05F, 0.1F, 0.2F, 0.35F, 0.5F, 0.8F}) {
    float low = 1;
    float high = 0;
    for (int s = 0; s <= 10; ++s) {
      for (int c = -10; c <= 10; ++c) {
        const float code = tone_curve(x, static_cast<float>(s) / 10.0F, static_cast<float>(c) / 10.0F);
        low = std::min(low, code);
        high = std::max(high, code);
      }
    }
    EXPECT_GT(std::log2(linear_from_srgb(low) / x), -1.25F) << x;
    EXPECT_LT(std::log2(linear_from_srgb(high) / x), 1.25F) << x;
    if (x == 0.5F) {
      EXPECT_LT(low, srgb_from_linear(x) - 0.05F);
      EXPECT_GT(high, srgb_from_linear(x) + 0.1F);
    }
  }
}

TEST(ToneCurve, ShoulderCompressesHighlightsOnly) {
  const auto slope = [](float x, float shoulder) {
    return (tone_curve(x, shoulder, 0) - tone_curve(x - 0.01F, shoulder, 0)) / 0.01F;
  };
  EXPECT_LT(slope(1.0F, 1.0F), 0.3F * slope(1.0F, 0.0F));
  EXPECT_GT(slope(0.2F, 1.0F), slope(0.2F, 0.0F));
}

TEST(ToneCurve, TableFollowsTheCurve) {
  for (const float shoulder : {0.0F, 1.0F}) {
    for (const float contrast : {-1.0F, 0.0F, 1.0F}) {
      std::vector<float> values;
      for (int i = 0; i <= 20000; ++i) values.push_back(static_cast<float>(i) / 20000.0F);
      std::vector<float> codes = values;
      ToneTable(shoulder, contrast).encode(codes.data(), codes.size());
      // Curvature over the square root is at most 26 (the straight foot of sRGB) * 1.5: h^2 / 8 of it, h = 1 / 1024, is 5e-6,
      // times 255 codes; float rounding is below.
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_NEAR(codes[i], 255.0F * tone_curve(values[i], shoulder, contrast), 3e-3F) << values[i];
      }
    }
  }
}

TEST(ToneCurve, WhatIsBeyondBlackAndWhiteStaysThere) {
  std::vector<float> values = {
      -1, 0, 1, 2, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
  ToneTable(0.5F, 0.5F).encode(values.data(), values.size());
  for (const std::size_t i : {0U, 1U, 5U}) EXPECT_NEAR(values[i], 0, 1e-3F);
  for (const std::size_t i : {2U, 3U, 4U}) EXPECT_NEAR(values[i], 255, 1e-3F);
}

}  // namespace
}  // namespace faceprobe::synth

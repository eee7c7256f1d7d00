#include "faceprobe/core/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace faceprobe {
namespace {

TEST(Color, CurveMatchesItsDefinition) {
  EXPECT_FLOAT_EQ(linear_from_srgb(1.0F), 1.0F);
  EXPECT_FLOAT_EQ(linear_from_srgb(0.0F), 0.0F);
  EXPECT_NEAR(linear_from_srgb(0.5F), 0.2140411, 1e-6);  // ((.5 + .055) / 1.055)^2.4
  EXPECT_NEAR(linear_from_srgb(0.04F), 0.04 / 12.92, 1e-8);
}

TEST(Color, EveryCodeSurvivesDecodeAndEncode) {
  ByteImage codes(256, 1, 1);
  for (int i = 0; i < 256; ++i) codes(i, 0) = static_cast<std::uint8_t>(i);
  EXPECT_EQ(encode_srgb(decode_srgb(codes)), codes);
}

TEST(Color, TableStaysWithinHalfACodeOfTheCurve) {
  Image ramp(10'001, 1, 1);
  for (int i = 0; i <= 10'000; ++i) ramp(i, 0) = static_cast<float>(i) * 1e-4F;
  const ByteImage codes = encode_srgb(ramp);
  for (int i = 0; i <= 10'000; ++i) {
    // Half a code for the rounding to bytes, half a code for the table's step.
    EXPECT_NEAR(codes(i, 0), 255.0F * srgb_from_linear(ramp(i, 0)), 1.0F) << i;
  }
}

TEST(Color, OddValuesClipInsteadOfWrapping) {
  Image odd(4, 1, 1);
  odd(0, 0) = -1.0F;
  odd(1, 0) = 1e30F;
  odd(2, 0) = std::numeric_limits<float>::quiet_NaN();
  odd(3, 0) = std::numeric_limits<float>::infinity();
  const ByteImage codes = encode_srgb(odd);
  EXPECT_EQ(codes(0, 0), 0);
  EXPECT_EQ(codes(1, 0), 255);
  EXPECT_EQ(codes(2, 0), 0);
  EXPECT_EQ(codes(3, 0), 255);
}

TEST(Color, LuminanceIsTheWeightedSumInBothPrecisions) {
  EXPECT_DOUBLE_EQ(luminance_weights<double>().sum(), 1.0);  // white has the luminance of its channels
  const Eigen::Vector3d colour(0.5, 0.25, 2.0);
  EXPECT_DOUBLE_EQ(luminance(colour.data()), 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 2.0);
  const Eigen::Vector3f single = colour.cast<float>();
  EXPECT_FLOAT_EQ(luminance(single.data()), 0.4295F);
  Eigen::MatrixX3f colours(2, 3);
  colours << single.transpose(), 0.0F, 1.0F, 0.0F;
  const Eigen::VectorXf levels = colours * kLuminanceWeights;
  EXPECT_FLOAT_EQ(levels[0], luminance(single.data()));
  EXPECT_EQ(levels[1], 0.7152F);
}

TEST(Color, ExposurePutsTheQuantileWhereAsked) {
  Image grey(101, 1, 3);
  for (int i = 0; i <= 100; ++i) {
    for (int c = 0; c < 3; ++c) grey(i, 0, c) = static_cast<float>(i);
  }
  EXPECT_NEAR(exposure_for_quantile(grey, 0.5F, 0.25F) * 50.0F, 0.25F, 1e-6);
  EXPECT_FLOAT_EQ(exposure_for_quantile(Image(3, 3, 3), 0.5F, 0.5F), 1.0F);
}

}  // namespace
}  // namespace faceprobe

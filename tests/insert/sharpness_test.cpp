#include "faceprobe/core/random.h"
#include "faceprobe/insert/photo_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace faceprobe::insert {
namespace {

struct Edge {
  double sigma = 0;     // of the Gaussian the step went through
  double angle = 0;     // of its normal
  double bright = 0.8;  // on the far side; .05 on this one
  double noise = 0;
};

// The exact picture of a step through the middle, sampled at pixel centres.
Image step_picture(const Edge& edge) {
  constexpr int kSide = 320;
  Image picture(kSide, kSide, 1);
  Random random({5});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double across = std::cos(edge.angle) * (x - 160.2) + std::sin(edge.angle) * (y - 160.2);
      const double part = edge.sigma > 0 ? 0.5 * std::erfc(-across / edge.sigma / std::numbers::sqrt2) : across > 0;
      picture(x, y) = static_cast<float>(0.05 + (edge.bright - 0.05) * part + edge.noise * random.normal());
    }
  }
  return picture;
}

// The central differences are taken for Gaussians of equal variance, which is off by up to 3 % of the deviation.
TEST(EstimateBlur, FindsTheGaussianOfAStep) {
  for (const double sigma : {0.7, 1.0, 2.0, 3.5}) {
    for (const double angle : {0.0, 0.3, 0.785, 1.4}) {
      EXPECT_NEAR(estimate_blur_px(step_picture({sigma, angle})), sigma, 0.03 * sigma + 0.01) << sigma << ' ' << angle;
    }
  }
}

// Of tiles that differ by chance a low quantile is taken, so noise pulls the figure down.
TEST(EstimateBlur, BearsNoise) {
  for (const double sigma : {0.7, 1.0, 2.0}) {
    for (const double angle : {0.0, 0.3, 0.785}) {
      const float found = estimate_blur_px(step_picture({.sigma = sigma, .angle = angle, .noise = 0.02}));
      EXPECT_NEAR(found, sigma, 0.08 * sigma) << sigma << ' ' << angle;
    }
  }
}

TEST(EstimateBlur, IsNextToNothingForAPerfectStep) {
  EXPECT_LT(estimate_blur_px(step_picture({.sigma = 0})), 0.1F);
  EXPECT_LT(estimate_blur_px(step_picture({.sigma = 0, .angle = 0.3})), 0.3F);
}

TEST(EstimateBlur, IsThatOfTheSharpestEdges) {
  Image picture = step_picture({.sigma = 3, .angle = 0});
  const Image sharp = step_picture({.sigma = 0.8, .angle = 0});
  for (int y = 0; y < 128; ++y) std::copy(sharp.row(y).begin(), sharp.row(y).end(), picture.row(y).begin());
  EXPECT_NEAR(estimate_blur_px(picture), 0.8F, 0.06F);
}

TEST(EstimateBlur, AddsUpWithBlur) {
  const Image sharp = step_picture({.sigma = 0.8, .angle = 0.3});
  EXPECT_NEAR(estimate_blur_px(blur(sharp, blur_to_match(1.5F, 0.8F))), 1.5F, 0.05F);
  EXPECT_EQ(blur_to_match(0.5F, 0.8F), 0);
}

// A clipped edge is steeper than the lens made it.
TEST(EstimateBlur, SaysUnknownWhereNoEdgeTells) {
  Image clipped = step_picture({.sigma = 2, .bright = 3});
  for (float& value : clipped.values()) value = std::min(value, 1.0F);
  EXPECT_EQ(estimate_blur_px(clipped), kUnknownBlurPx);
  EXPECT_EQ(estimate_blur_px(Image(200, 200, 3, 0.4F)), kUnknownBlurPx);
  EXPECT_EQ(estimate_blur_px(Image(1, 1, 3, 0.4F)), kUnknownBlurPx);
  EXPECT_EQ(estimate_blur_px({}), kUnknownBlurPx);
  EXPECT_EQ(estimate_blur_px(Image(200, 200, 1, std::numeric_limits<float>::quiet_NaN())), kUnknownBlurPx);
  EXPECT_THROW(estimate_blur_px(Image(9, 9, 2)), std::invalid_argument);
}

TEST(Blur, SpreadsAPointAsAGaussian) {
  for (const float sigma : {0.1F, 0.4F, 1.0F, 3.0F}) {
    Image point(65, 65, 2);
    point(32, 32, 1) = 1;
    const Image soft = blur(point, sigma);
    double sum = 0;
    double moment = 0;
    for (int y = 0; y < 65; ++y) {
      for (int x = 0; x < 65; ++x) {
        EXPECT_EQ(soft(x, y, 0), 0);
        sum += static_cast<double>(soft(x, y, 1));
        moment += (x - 32) * (x - 32) * static_cast<double>(soft(x, y, 1));
      }
    }
    const double variance = static_cast<double>(sigma) * static_cast<double>(sigma);
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(moment, variance, 1e-5 * variance + 1e-7);  // the discrete Gaussian's is exact, floats are not
  }
}

TEST(Blur, KeepsAConstantToTheBorderAndZeroTheSame) {
  const Image even(20, 7, 4, 0.6F);
  const Image soft = blur(even, 5);
  for (const float value : soft.values()) EXPECT_NEAR(value, 0.6F, 1e-5F);
  const Image picture = step_picture({.sigma = 1});
  EXPECT_EQ(blur(picture, 0), picture);
  EXPECT_EQ(blur(picture, 1.3F), blur(picture, 1.3F));
  EXPECT_TRUE(blur({}, 2).empty());
}

TEST(Blur, RefusesAbsurdDeviations) {
  const Image picture(4, 4, 1);
  EXPECT_THROW(blur(picture, -1), std::invalid_argument);
  EXPECT_THROW(blur(picture, 65), std::invalid_argument);
  EXPECT_THROW(blur(picture, std::numeric_limits<float>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::insert

// RMSE, scale-invariant RMSE and colour angle against what they must be by hand.
#include "faceprobe/eval/image_metrics.h"

#include "eval/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::eval::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Rmse, OfAConstantOffsetIsTheOffset) {
  const Image a(23, 17, 3, 0.25F);
  EXPECT_EQ(rmse(a, Image(23, 17, 3, 0.375F)), 255 * 0.125);  // exact in binary
  EXPECT_EQ(rmse(a, a), 0);
  const Image b = noise(23, 17, 3, 1);
  EXPECT_NEAR(rmse(affine(b, 1, 0.1F), b), 25.5, 1e-5);  // values rounded to float
}

TEST(Rmse, AveragesSquaresOverPixelsAndChannels) {
  Image a(2, 1, 3);
  const Image b(2, 1, 3);
  a(0, 0, 1) = 3.0F / 255;
  a(1, 0, 2) = -4.0F / 255;
  EXPECT_NEAR(rmse(a, b), std::sqrt((9.0 + 16.0) / 6), 1e-6);  // 3 / 255 in float
  EXPECT_EQ(rmse(a, b), rmse(b, a));
}

TEST(Rmse, LooksInsideTheMaskOnly) {
  Image a(20, 10, 3, 0.5F);
  const Image b = a;
  for (int y = 0; y < 10; ++y) {
    for (int x = 10; x < 20; ++x) a(x, y, 0) = kNan;
    a(3, y, 1) += 0.25F;  // one of thirty values of the left half
  }
  EXPECT_NEAR(rmse(a, b, left_half(20, 10)), 255 * 0.25 / std::sqrt(30.0), 1e-12);
  EXPECT_TRUE(std::isnan(rmse(a, b)));
}

TEST(Metrics, AreNanWhenThereIsNothingToCompare) {
  const Image a(20, 20, 3, 0.5F);
  const ByteImage nowhere(20, 20, 1);
  EXPECT_TRUE(std::isnan(rmse(a, a, nowhere)));
  EXPECT_TRUE(std::isnan(si_rmse(a, a, nowhere)));
  EXPECT_TRUE(std::isnan(ssim(a, a, nowhere)));
  EXPECT_TRUE(std::isnan(angular_error_deg(a, a, nowhere)));
  EXPECT_TRUE(std::isnan(rmse({}, {})));
  EXPECT_TRUE(std::isnan(angular_error_deg(Image(4, 4, 3), Image(4, 4, 3))));  // black
}

TEST(Metrics, RefusePicturesThatDoNotFit) {
  const Image a(20, 20, 3);
  EXPECT_THROW(rmse(a, Image(20, 19, 3)), std::invalid_argument);
  EXPECT_THROW(ssim(a, Image(20, 20, 1)), std::invalid_argument);
  EXPECT_THROW(si_rmse(a, a, ByteImage(19, 20, 1)), std::invalid_argument);
  EXPECT_THROW(rmse(a, a, ByteImage(20, 20, 3)), std::invalid_argument);
  EXPECT_THROW(angular_error_deg(Image(20, 20, 1), Image(20, 20, 1)), std::invalid_argument);
}

TEST(Metrics, GiveTheSameForAnyNumberOfThreads) {
  const Image a = noise(61, 47, 3, 1);
  const Image b = noise(61, 47, 3, 2);
  for (const int threads : {2, 5, 100}) {
    EXPECT_EQ(rmse(a, b, {}, threads), rmse(a, b, {}, 1));
    EXPECT_EQ(ssim(a, b, {}, threads), ssim(a, b, {}, 1));
    EXPECT_EQ(si_rmse(a, b, {}, threads), si_rmse(a, b, {}, 1));
    EXPECT_EQ(angular_error_deg(a, b, {}, 1e-3, threads), angular_error_deg(a, b, {}, 1e-3, 1));
  }
}

TEST(SiRmse, DoesNotSeeTheScaleOfTheEstimate) {
  const Image a = noise(40, 30, 3, 3);
  const Image b = noise(40, 30, 3, 4);
  EXPECT_NEAR(si_rmse(affine(b, 0.25F), b), 0, 1e-15);          // a power of two: no rounding of the pictures
  EXPECT_NEAR(si_rmse(affine(a, 8), b), si_rmse(a, b), 1e-15);  // same
  EXPECT_LT(si_rmse(a, b), rmse(a, b) / 255);                   // the best of all scales, 1 among them
}

TEST(SiRmse, IsWhatTheProjectionLeaves) {
  Image a(1, 1, 3);
  Image b(1, 1, 3);
  a(0, 0, 0) = 2;
  b(0, 0, 0) = 3;
  b(0, 0, 1) = 4;
  EXPECT_NEAR(si_rmse(a, b), std::sqrt(16.0 / 3), 1e-15);               // the part of b that a does not reach
  EXPECT_NEAR(si_rmse(Image(1, 1, 3), b), std::sqrt(25.0 / 3), 1e-15);  // black estimate
}

TEST(AngularError, IsTheAngleBetweenColours) {
  Image a(2, 1, 3);
  Image b(2, 1, 3);
  a(0, 0, 0) = 0.5F;                 // red
  b(0, 0, 1) = 0.25F;                // green: 90 degrees
  a(1, 0, 0) = 1;                    // red
  b(1, 0, 0) = b(1, 0, 2) = 0.125F;  // purple: 45 degrees
  EXPECT_NEAR(angular_error_deg(a, b), 67.5, 1e-12);
  EXPECT_NEAR(angular_error_deg(b, a), 67.5, 1e-12);
}

TEST(AngularError, DoesNotSeeBrightnessAndSkipsBlack) {
  const Image a = noise(40, 30, 3, 5);
  Image b = noise(40, 30, 3, 6);
  EXPECT_NEAR(angular_error_deg(a, affine(a, 4)), 0, 1e-12);
  EXPECT_NEAR(angular_error_deg(affine(a, 4), b, {}, 0), angular_error_deg(a, b, {}, 0), 1e-12);
  Image one_pixel(40, 30, 3);
  one_pixel(7, 7, 0) = 1;
  b(7, 7, 0) = 1;
  b(7, 7, 1) = 1;
  b(7, 7, 2) = 0;
  EXPECT_NEAR(angular_error_deg(one_pixel, b), 45, 1e-12);
  b(7, 7, 1) = kNan;
  EXPECT_TRUE(std::isnan(angular_error_deg(one_pixel, b)));
}

}  // namespace
}  // namespace faceprobe::eval::testing

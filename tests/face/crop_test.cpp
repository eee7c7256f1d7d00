#include "faceprobe/core/error.h"
#include "faceprobe/face/geometry.h"

#include <gtest/gtest.h>

namespace faceprobe::face {
namespace {

Image ramp(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y, 0) = static_cast<float>(x) + 0.5F;
      image(x, y, 1) = static_cast<float>(y) + 0.5F;
      image(x, y, 2) = static_cast<float>((x * 7 + y * 13) % 5);
    }
  }
  return image;
}

TEST(Crop, CoordinatesRoundTrip) {
  const Crop crop{-3.5, 12.25, 0.37, 40, 30};
  const Eigen::Vector2d there = crop.photo_from_crop(7, 9);
  EXPECT_NEAR((crop.crop_from_photo(there.x(), there.y()) - Eigen::Vector2d(7, 9)).norm(), 0, 1e-12);
}

TEST(Crop, ScaleOneCopiesPixels) {
  const Image photo = ramp(12, 10);
  const Image out = crop_picture(photo, {3, 2, 1, 5, 4});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(out(x, y, k), photo(x + 3, y + 2, k));
    }
  }
}

TEST(Crop, ShrinkingAveragesAreaAndKeepsRamps) {
  const Image photo = ramp(60, 60);
  const Crop crop{4.3, 5.7, 0.31, 10, 10};
  const Image out = crop_picture(photo, crop);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      // The mean of a staircase over an interval that starts within a step is off by at most 1/8 step / (3.2 steps).
      const Eigen::Vector2d centre = crop.photo_from_crop(x + 0.5, y + 0.5);
      EXPECT_NEAR(out(x, y, 0), centre.x(), 0.08);
      EXPECT_NEAR(out(x, y, 1), centre.y(), 0.08);
    }
  }
  // Whole-number shrinking is the plain mean.
  const Image third = crop_picture(photo, {0, 0, 1.0 / 3, 20, 20});
  float sum = 0;
  for (int y = 3; y < 6; ++y) {
    for (int x = 6; x < 9; ++x) sum += photo(x, y, 2);
  }
  EXPECT_NEAR(third(2, 1, 2), sum / 9, 1e-5);
}

TEST(Crop, EnlargingIsBilinear) {
  const Image photo = ramp(20, 20);
  const Crop crop{5, 5, 4, 16, 16};
  const Image out = crop_picture(photo, crop);
  for (int x = 0; x < 16; ++x) EXPECT_NEAR(out(x, 3, 0), crop.photo_from_crop(x + 0.5, 0).x(), 1e-5);
}

TEST(Crop, OutsideIsBlackAndFlagged) {
  const Image white(8, 8, 1, 1.0F);
  for (const double scale : {0.5, 1.0, 2.0}) {
    const Crop crop{-8, -8, scale, static_cast<int>(24 * scale), static_cast<int>(24 * scale)};
    const Image out = crop_picture(white, crop);
    const ByteImage flags = crop_flags(ByteImage(8, 8, 1), crop);
    for (int y = 0; y < crop.height; ++y) {
      for (int x = 0; x < crop.width; ++x) {
        const Eigen::Vector2d photo = crop.photo_from_crop(x + 0.5, y + 0.5);
        const bool within = photo.minCoeff() > 0 && photo.maxCoeff() < 8;
        EXPECT_EQ(out(x, y), within ? 1.0F : 0.0F);
        EXPECT_EQ(flags(x, y), within ? 0 : 0xFF);
      }
    }
  }
}

TEST(Crop, FlagsAreOred) {
  ByteImage flags(9, 9, 1);
  flags(1, 1) = 1;
  flags(2, 0) = 4;
  flags(8, 8) = 2;
  const ByteImage out = crop_flags(flags, {0, 0, 1.0 / 3, 3, 3});
  EXPECT_EQ(out(0, 0), 5);
  EXPECT_EQ(out(2, 2), 2);
  EXPECT_EQ(out(1, 1), 0);
}

TEST(Crop, RefusesImpossibleCrops) {
  EXPECT_THROW(crop_picture(Image(4, 4, 1), {0, 0, 0, 4, 4}), Error);
  EXPECT_THROW(crop_flags(ByteImage(4, 4, 1), {0, 0, 1, -1, 4}), Error);
}

}  // namespace
}  // namespace faceprobe::face

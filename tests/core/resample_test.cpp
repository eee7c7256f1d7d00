#include "faceprobe/core/resample.h"

#include <gtest/gtest.h>

namespace faceprobe {
namespace {

Image ramp(int width, int height) {
  Image image(width, height, 2);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y, 0) = static_cast<float>(x + 0.5);
      image(x, y, 1) = static_cast<float>(y + 0.5);
    }
  }
  return image;
}

// A ramp tells of each pixel where it is from; both interpolation and the mean are exact on it.
TEST(Resample, EachPixelIsFromWhereTheWindowSays) {
  for (const double scale : {0.4, 1.0, 1.7}) {
    const Window window{.left_px = 5.3, .top_px = 4.1, .scale = scale, .width = 6, .height = 5};
    const Image part = resampled(ramp(40, 30), window);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        EXPECT_NEAR(part(x, y, 0), 5.3 + (x + 0.5) / scale, 1e-5) << scale;  // float
        EXPECT_NEAR(part(x, y, 1), 4.1 + (y + 0.5) / scale, 1e-5) << scale;
      }
    }
  }
}

TEST(Resample, APictureIsShrunkToALongSide) {
  const Window window = shrunk(3000, 2000, 600);
  EXPECT_DOUBLE_EQ(window.scale, 0.2);
  EXPECT_EQ(window.width, 600);
  EXPECT_EQ(window.height, 400);
  const Window flat = shrunk(3000, 1, 600);
  EXPECT_EQ(flat.height, 1);  // never nothing
  const Window small = shrunk(30, 20, 600);
  EXPECT_EQ(small.scale, 1);
  EXPECT_EQ(small.width, 30);
}

TEST(Resample, ShrinkingKeepsTheMean) {
  Image checks(8, 8, 1);
  for (int i = 0; i < 64; ++i) checks.data()[i] = static_cast<float>((i % 8 + i / 8) % 2);
  const Image quarter = resampled(checks, {.left_px = 0, .top_px = 0, .scale = 0.25, .width = 2, .height = 2});
  for (const float value : quarter.values()) EXPECT_FLOAT_EQ(value, 0.5F);
}

TEST(Resample, OutsideIsBlackOrTheEdge) {
  const Image white(4, 4, 1, 1.0F);
  const Window window{.left_px = -4, .top_px = 0, .scale = 1, .width = 8, .height = 4};
  EXPECT_EQ(resampled(white, window)(0, 1), 0.0F);
  EXPECT_EQ(resampled(white, window)(5, 1), 1.0F);
  EXPECT_EQ(resampled(white, window, Outside::kEdge)(0, 1), 1.0F);
  const ByteImage ones(4, 4, 1, 1);
  EXPECT_EQ(resampled(ones, window)(0, 1), 1);
  EXPECT_EQ(resampled(ones, window, 9)(0, 1), 9);
  EXPECT_EQ(resampled(ones, window, 9)(4, 1), 1);
}

TEST(Resample, NearestMixesNothing) {
  Image halves(8, 4, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 4; x < 8; ++x) halves(x, y) = 1;
  }
  const Image part = nearest(halves, {.left_px = 1, .top_px = 0, .scale = 1.7, .width = 14, .height = 6});
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 14; ++x) {
      const double from = 1 + (x + 0.5) / 1.7;
      EXPECT_EQ(part(x, y), from >= 4 && from < 8 ? 1.0F : 0.0F);  // 0 outside, too
    }
  }
}

TEST(Resample, TheWindowBackShowsThePictureAgain) {
  const Image picture = ramp(20, 16);
  const Window window{.left_px = 2, .top_px = 3, .scale = 1.5, .width = 21, .height = 18};
  const Image back = resampled(resampled(picture, window), window.back_to(20, 16));
  for (int y = 5; y < 13; ++y) {
    for (int x = 4; x < 14; ++x) {
      EXPECT_NEAR(back(x, y, 0), picture(x, y, 0), 1e-4);
      EXPECT_NEAR(back(x, y, 1), picture(x, y, 1), 1e-4);
    }
  }
}

}  // namespace
}  // namespace faceprobe

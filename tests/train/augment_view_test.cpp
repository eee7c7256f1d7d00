#include "train/augment_view.h"

#include <gtest/gtest.h>

namespace faceprobe::train {
namespace {

// Light that grows evenly to the right and downwards; a clipped pixel and a skin pixel in the middle.
TrainingPicture ramp(int size) {
  TrainingPicture picture{Image(size, size, 3), ByteImage(size, size, 3), ByteImage(size, size, 1, 1),
                          Image(size, size, 3), ByteImage(size, size, 1, 1)};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture.linear(x, y, c) = 0.01F * static_cast<float>(x + 2 * y + c) + 0.1F;
        picture.highlight(x, y, c) = 0.5F * picture.linear(x, y, c);
      }
    }
  }
  picture.clip(size / 2, size / 2, 1) = 1;
  return picture;
}

TEST(AugmentView, ZoomOneChangesNothing) {
  const TrainingPicture picture = ramp(16);
  const TrainingPicture same = seen_through(zoom_window(picture, 1, 5, 9), picture);
  for (std::size_t i = 0; i < picture.linear.values().size(); ++i) {
    EXPECT_NEAR(same.linear.data()[i], picture.linear.data()[i], 1e-6) << i;  // float rounding of the weights
    EXPECT_NEAR(same.highlight.data()[i], picture.highlight.data()[i], 1e-6) << i;
  }
  EXPECT_EQ(same.clip, picture.clip);
  EXPECT_EQ(same.skin, picture.skin);
}

TEST(AugmentView, ZoomKeepsItsCentreAndARampARamp) {
  const TrainingPicture picture = ramp(32);
  const double zoom = 2;
  const TrainingPicture larger = seen_through(zoom_window(picture, zoom, 12, 20), picture);
  for (int y = 4; y < 28; ++y) {
    for (int x = 4; x < 28; ++x) {
      const double from_x = 12 + (x + 0.5 - 12) / zoom - 0.5;
      const double from_y = 20 + (y + 0.5 - 20) / zoom - 0.5;
      EXPECT_NEAR(larger.linear(x, y, 0), 0.01 * (from_x + 2 * from_y) + 0.1,
                  1e-5);  // linear interpolation is exact here
      EXPECT_NEAR(larger.highlight(x, y, 2), 0.5 * larger.linear(x, y, 2), 1e-6);
    }
  }
}

TEST(AugmentView, WhatComesFromOutsideIsBlackAndMarkedAndNoSkin) {
  const TrainingPicture smaller = seen_through(zoom_window(ramp(32), 0.5, 16, 16), ramp(32));
  int outside = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const bool shown = x >= 8 && x < 24 && y >= 8 && y < 24;
      if (shown) continue;
      ++outside;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(smaller.linear(x, y, c), 0);
        EXPECT_EQ(smaller.highlight(x, y, c), 0);
        EXPECT_EQ(smaller.clip(x, y, c), 1);
      }
      EXPECT_EQ(smaller.skin(x, y), 0);
      EXPECT_EQ(smaller.mask(x, y), 1);
    }
  }
  EXPECT_EQ(outside, 32 * 32 - 16 * 16);
}

TEST(AugmentView, CutSidesAreAsOutsideAndTheRestIsUntouched) {
  const TrainingPicture whole = ramp(16);
  TrainingPicture picture = whole;
  cut_sides({.left = 3, .top = 0, .right = 16, .bottom = 12}, picture);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool shown = x >= 3 && y < 12;
      EXPECT_EQ(picture.linear(x, y, 1), shown ? whole.linear(x, y, 1) : 0.0F);
      EXPECT_EQ(picture.clip(x, y, 0), shown ? whole.clip(x, y, 0) : 1);
      EXPECT_EQ(picture.skin(x, y), shown ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace faceprobe::train

#include "faceprobe/io/text.h"

#include <gtest/gtest.h>

namespace faceprobe::io {
namespace {

constexpr std::array<std::uint8_t, 3> kYellow = {255, 220, 0};

struct Ink {
  int count = 0;
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Ink ink_of(const ByteImage& picture) {
  Ink ink;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture(x, y, 0) < 128) continue;
      ++ink.count;
      ink.left = std::min(ink.left, x);
      ink.right = std::max(ink.right, x);
      ink.top = std::min(ink.top, y);
      ink.bottom = std::max(ink.bottom, y);
    }
  }
  return ink;
}

TEST(Text, StandsOnItsBaseline) {
  ByteImage picture(200, 60, 3);
  if (!draw_text(picture, 20, 40, "HELLO", 24, kYellow)) GTEST_SKIP() << "DejaVu Sans is not installed";
  const Ink ink = ink_of(picture);
  EXPECT_GT(ink.count, 100);
  EXPECT_GE(ink.left, 20);
  EXPECT_LE(ink.left, 24);  // the letter's own margin
  EXPECT_LE(ink.bottom, 40);
  EXPECT_GE(ink.bottom, 38);  // capitals end on the baseline
  // DejaVu's capitals are 0.729 em high: 17.5 px, and hinting moves an edge by at most a pixel.
  EXPECT_NEAR(ink.bottom - ink.top + 1, 17.5, 1.6);
  EXPECT_EQ(picture(ink.left, ink.bottom - 3, 2), 0);  // yellow has no blue
}

TEST(Text, BoldHasMoreInk) {
  ByteImage plain(200, 60, 3);
  ByteImage bold(200, 60, 3);
  if (!draw_text(plain, 10, 40, "light", 24, kYellow) || !draw_text(bold, 10, 40, "light", 24, kYellow, true)) {
    GTEST_SKIP() << "DejaVu Sans is not installed";
  }
  EXPECT_GT(ink_of(bold).count, ink_of(plain).count * 11 / 10);
}

TEST(Text, OutsideThePictureIsHarmless) {
  ByteImage picture(30, 20, 3);
  draw_text(picture, -500, -500, "far away", 20, kYellow);
  draw_text(picture, 20, 15, "over the edge \xc3\xa9 \xff", 40, kYellow);
  EXPECT_EQ(picture.width(), 30);
  ByteImage mask(10, 10, 1);
  EXPECT_THROW(draw_text(mask, 0, 0, "x", 10, kYellow), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::io

#include "faceprobe/lighting/surround.h"

#include "faceprobe/lighting/observations.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::lighting {
namespace {

// Left half red, right half green, the upper quarter at white.
Image scene(int width, int height) {
  Image picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture(x, y, x < width / 2 ? 0 : 1) = 0.5F;
      if (y < height / 4) picture(x, y, 2) = 1.0F;
    }
  }
  return picture;
}

TEST(SurroundOf, TellsTheSidesApart) {
  const Surround around = surround_of(scene(400, 400), {200, 200}, 40);
  // Sector 0 is just above +x, to the right; half a turn on is -x. All sectors of 3.2 * 40 px lie in the picture.
  for (int ring = 0; ring < kSurroundRings; ++ring) {
    const int right = ring * kSurroundAngles;
    const int left = right + kSurroundAngles / 2;
    EXPECT_FLOAT_EQ(around(right, 1), 0.5F);
    EXPECT_FLOAT_EQ(around(right, 0), 0);
    EXPECT_FLOAT_EQ(around(left, 0), 0.5F);
    EXPECT_FLOAT_EQ(around(left, 4), 1);
  }
  // The white begins 100 px above the middle, 2.5 half heights: only the outermost ring's upper sectors see it.
  EXPECT_GT(around(2 * kSurroundAngles + 2, 3), 0.1F);
  EXPECT_EQ(around(2 * kSurroundAngles + 9, 3), 0);
  EXPECT_EQ(around(kSurroundAngles + 2, 3), 0);
}

TEST(SurroundOf, KnowsWhatThePhotoCutsOff) {
  const Surround around = surround_of(scene(400, 400), {10, 200}, 40);
  const int left = kSurroundAngles / 2;
  EXPECT_EQ(around(left, 4), 0);
  EXPECT_TRUE(around.row(left).isZero());
  EXPECT_FLOAT_EQ(around(0, 4), 1);
}

TEST(SurroundOf, IsTheSameForEverySizeOfPhoto) {
  const Surround small = surround_of(scene(200, 200), {100, 100}, 20);
  const Surround large = surround_of(scene(1600, 1600), {800, 800}, 160);
  // Twelve points a half height: at 20 px they fall on pixels 1.7 px apart, and an edge is placed to about one of them.
  EXPECT_LT((small - large).cwiseAbs().maxCoeff(), 0.1F);
}

TEST(SurroundOf, MirrorsWithThePhoto) {
  Image turned(400, 300, 3);
  Image picture(400, 300, 3);
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) {
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = static_cast<float>((x * (c + 1) + 3 * y) % 97) / 97;
        turned(399 - x, y, c) = picture(x, y, c);
      }
    }
  }
  // Half a pixel off the lattice, so that no point falls on a border between pixels in one picture alone.
  const Surround here = surround_of(picture, {200, 150}, 37.3F);
  const Surround there = surround_of(turned, {200, 150}, 37.3F);
  EXPECT_LT((mirrored(here) - there).cwiseAbs().maxCoeff(), 1e-5F);  // the order of sums
  EXPECT_LT((mirrored(mirrored(here)) - here).cwiseAbs().maxCoeff(), 1e-7F);
}

TEST(SurroundOf, RefusesGreyPicturesAndFacesWithoutHeight) {
  EXPECT_THROW(surround_of(Image(8, 8, 1), {4, 4}, 2), std::invalid_argument);
  EXPECT_THROW(surround_of(Image(8, 8, 3), {4, 4}, 0), std::invalid_argument);
}

TEST(Concatenate, TakesTheMeanOfTheSurroundsThatAreKnown) {
  Observations known;
  known.resize(1);
  known.normal.row(0) = known.view.row(0) = Eigen::RowVector3f(0, 0, 1);
  known.surround.row(3) << 0.2F, 0.4F, 0.6F, 0.1F, 1;
  Observations other = known;
  other.surround.row(3) << 0.4F, 0.4F, 0.4F, 0.3F, 1;
  Observations unknown = known;
  unknown.surround.setZero();
  const Surround around = concatenate({known, other, unknown}).surround;
  EXPECT_FLOAT_EQ(around(3, 0), 0.3F);
  EXPECT_FLOAT_EQ(around(3, 3), 0.2F);
  EXPECT_FLOAT_EQ(around(3, 4), 2.0F / 3);
  EXPECT_TRUE(around.row(4).isZero());
}

}  // namespace
}  // namespace faceprobe::lighting

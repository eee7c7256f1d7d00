#include "faceprobe/lighting/recolour.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

Observations one_patch() {
  Observations o;
  o.resize(1);
  o.normal.row(0) = Eigen::RowVector3f(0, 0, 1);
  o.view.row(0) = Eigen::RowVector3f(0, 0, 1);
  o.highlight.row(0) = Eigen::RowVector3f(0.1F, 0.2F, 0.3F);
  o.shading.row(0) = Eigen::RowVector3f(0.8F, 0.6F, 0.4F);
  return o;
}

TEST(Recolour, UnclippedColourIsKept) {
  const Observations o = one_patch();
  EXPECT_TRUE(recolour_highlights(o) == o.highlight);
}

TEST(Recolour, BlueIsTheReferenceWhenItIsFree) {
  Observations o = one_patch();
  o.clipped.row(0) << true, true, false;
  const Eigen::MatrixX3f h = recolour_highlights(o);
  EXPECT_FLOAT_EQ(h(0, 0), 0.6F);   // .3 * .8 / .4
  EXPECT_FLOAT_EQ(h(0, 1), 0.45F);  // .3 * .6 / .4
  EXPECT_FLOAT_EQ(h(0, 2), 0.3F);
}

TEST(Recolour, GreenOrRedStandInForClippedBlue) {
  Observations o = one_patch();
  o.clipped.row(0) << false, false, true;
  EXPECT_FLOAT_EQ(recolour_highlights(o)(0, 2), 0.3F);  // .2 * .4 / .6 = .13 is below what was seen: never lowered
  o.highlight(0, 1) = 0.9F;
  EXPECT_FLOAT_EQ(recolour_highlights(o)(0, 2), 0.6F);
}

TEST(Recolour, WarmLightDoesNotExplode) {
  Observations o = one_patch();
  o.shading.row(0) = Eigen::RowVector3f(1.0F, 0.5F, 0.0F);
  o.clipped.row(0) << true, false, false;
  const Eigen::MatrixX3f h = recolour_highlights(o);
  EXPECT_TRUE(h.allFinite());
  EXPECT_LE(h(0, 0), 0.3F * 1.0F / 0.05F + 1e-4F);  // blue floored at a tenth of the mean shading
}

}  // namespace
}  // namespace faceprobe::lighting

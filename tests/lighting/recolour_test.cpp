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

void expect_row(const Eigen::MatrixX3f& rows, const Eigen::RowVector3f& wanted) {
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(rows(0, c), wanted[c]) << "channel " << c;
}

TEST(Recolour, BlueSaysHowStrongAndTheShadingWhatColour) {
  Observations o = one_patch();
  const Eigen::RowVector3f wanted(0.6F, 0.45F, 0.3F);  // .3 * (.8, .6, .4) / .4
  expect_row(recolour_highlights(o), wanted);
  o.clipped.row(0) << true, true, false;
  expect_row(recolour_highlights(o), wanted);
  o.clipped.row(0) << true, true, true;
  expect_row(recolour_highlights(o), wanted);
}

TEST(Recolour, GreenOrRedStandInForClippedBlue) {
  Observations o = one_patch();
  o.clipped.row(0) << false, false, true;
  expect_row(recolour_highlights(o), {0.2F * 8 / 6, 0.2F, 0.2F * 4 / 6});
  o.clipped.row(0) << false, true, true;
  expect_row(recolour_highlights(o), {0.1F, 0.075F, 0.05F});
}

TEST(Recolour, WithoutShadingTheColourIsKept) {
  Observations o = one_patch();
  o.shading.setZero();
  EXPECT_TRUE(recolour_highlights(o) == o.highlight);
}

TEST(Recolour, WarmLightDoesNotExplode) {
  Observations o = one_patch();
  o.shading.row(0) = Eigen::RowVector3f(1.0F, 0.5F, 0.0F);
  o.clipped.row(0) << true, false, false;
  const Eigen::MatrixX3f h = recolour_highlights(o);
  EXPECT_TRUE(h.allFinite());
  EXPECT_FLOAT_EQ(h(0, 0), 0.3F * 1.0F / 0.05F);  // blue floored at a tenth of the mean shading
}

}  // namespace
}  // namespace faceprobe::lighting

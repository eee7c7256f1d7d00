#include "faceprobe/lighting/harmonics.h"

#include "faceprobe/core/sh.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

// Shading that is made of harmonics of order 2 gives those back, as far as half a sphere of normals tells them apart.
TEST(Harmonics, ComeBackFromTheirShading) {
  Observations face = testing::ellipsoid_face();
  Eigen::MatrixX3d truth(9, 3);
  truth << 3, 2.5, 2, 0.8, 0.5, 0.2, 1, 1.1, 1.2, -0.6, -0.4, -0.2, 0.2, 0, 0, 0.1, 0.1, 0, -0.2, 0.1, 0, 0, 0.2, 0.1,
      0.1, 0, -0.1;
  for (Eigen::Index i = 0; i < face.count(); ++i)
    face.shading.row(i) =
        (sh::irradiance(truth, face.normal.row(i).transpose().cast<double>()) / 3.14159265358979).transpose().cast<float>();
  const Eigen::MatrixX3d found = fit_harmonics(face, 2, 1e-9);
  EXPECT_LT((found - truth).cwiseAbs().maxCoeff(), 0.02);  // shading in single precision, and normals of one side only
}

TEST(Harmonics, ALampIsBrightestOnItsSideAndNeverNegative) {
  const SphereGrid grid(16);
  Observations face = testing::ellipsoid_face();
  const Eigen::Vector3d towards = direction_from_angles(40, 10);
  testing::light_up(face, grid, testing::lamp(grid, towards, 1, 0.01F));
  const Eigen::MatrixX3f light = radiance_of_harmonics(fit_harmonics(face, 2), grid);
  EXPECT_GE(light.minCoeff(), 0);
  EXPECT_LT(angle_between_deg(testing::brightest_direction(light, grid), towards), 20);  // order 2 is broad
}

TEST(Harmonics, ClippedPatchesSayNothing) {
  Observations face = testing::ellipsoid_face();
  face.shading.setConstant(1);
  face.shading.topRows(10).setConstant(1000);
  face.clipped.topRows(10).setConstant(true);
  const Eigen::MatrixX3d found = fit_harmonics(face, 0, 1e-9);
  // Even radiance 1 is the coefficient sqrt(4 pi).
  EXPECT_NEAR(found(0, 0), std::sqrt(4 * 3.14159265358979), 1e-3);
  face.clipped.setConstant(true);
  EXPECT_TRUE(fit_harmonics(face, 2).isZero());
}

TEST(Harmonics, RefuseWhatMakesNoSense) {
  const Observations face = testing::ellipsoid_face();
  EXPECT_THROW(fit_harmonics(face, 5), std::invalid_argument);
  EXPECT_THROW(fit_harmonics(face, 2, 0), std::invalid_argument);
  EXPECT_THROW(radiance_of_harmonics(Eigen::MatrixX3d::Zero(7, 3), SphereGrid(4)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting

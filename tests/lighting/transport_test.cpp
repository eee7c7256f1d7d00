#include "faceprobe/lighting/transport.h"

#include "faceprobe/core/microfacet.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

TEST(Transport, DiffuseFurnaceIsOne) {
  // A convex surface under uniform radiance 1: shading 1 wherever it faces.
  const SphereGrid grid(16);
  const RowMatrix rows = build_transport(testing::ellipsoid_face(12), grid).diffuse();
  const Eigen::VectorXf sums = rows.rowwise().sum();
  EXPECT_NEAR(sums.minCoeff(), 1.0F, 0.005F);  // cosine over 3072 cells
  EXPECT_NEAR(sums.maxCoeff(), 1.0F, 0.005F);
}

TEST(Transport, LightsAnywhereAreSeenAsCellsAre) {
  const SphereGrid grid(4);
  Observations face = testing::ellipsoid_face(12);
  face.horizon.setConstant(face.count(), kHorizonAzimuths, 0.3F);
  const Transport cells = build_transport(face, grid);
  const Eigen::MatrixX3f some = grid.directions().middleRows(20, 30);
  const Transport lights = build_transport(face, some, 2 * static_cast<float>(grid.cell_solid_angle()));
  ASSERT_GT(lights.highlight().maxCoeff(), 0);
  EXPECT_TRUE(lights.highlight().isApprox(2 * cells.highlight().middleCols(20, 30), 1e-5F));
  EXPECT_TRUE(lights.diffuse().isApprox(2 * cells.diffuse().middleCols(20, 30), 1e-5F));
}

TEST(Transport, MirrorLightPeaksInTheMirrorDirection) {
  const SphereGrid grid(16);
  Observations one;
  one.resize(1);
  one.normal.row(0) = direction_from_angles(20, 10).transpose().cast<float>();
  one.view.row(0) = Eigen::RowVector3f(0, 0, 1);
  one.roughness[0] = 0.1F;
  const RowMatrix rows = build_transport(one, grid).highlight();
  Eigen::Index best = 0;
  rows.row(0).maxCoeff(&best);
  const Eigen::Vector3d n = one.normal.row(0).transpose().cast<double>();
  const Eigen::Vector3d mirrored = 2 * n.z() * n - Eigen::Vector3d::UnitZ();
  EXPECT_LT(angle_between_deg(grid.direction(static_cast<int>(best)).cast<double>(), mirrored), 3.7);  // one cell
}

TEST(Transport, FresnelIsConstantAtNormalIncidenceAndGrowsFromThere) {
  const SphereGrid grid(16);
  Observations two;
  two.resize(2);
  two.normal.row(0) = Eigen::RowVector3f(0, 0, 1);
  two.normal.row(1) = direction_from_angles(75, 0).transpose().cast<float>();
  two.view.rowwise() = Eigen::RowVector3f(0, 0, 1);
  const RowMatrix with = build_transport(two, grid).highlight();
  const RowMatrix without = build_transport(two, grid, 0, Fresnel::kConstant).highlight();
  for (int patch = 0; patch < 2; ++patch) {
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (without(patch, j) < 1e-20F)
        continue;  // the slopes there are next to none, and the numbers too small for a ratio
      const Eigen::Vector3f half = (grid.direction(j) + Eigen::Vector3f::UnitZ()).normalized();
      const float gain = schlick_fresnel(half.z(), kSkinF0) / kSkinF0;
      ASSERT_NEAR(with(patch, j) / without(patch, j), gain, 1e-4F * gain);  // rounding
    }
  }
  // Frontal skin mirrors what is before it, as at normal incidence; turned by 75 degrees it sees what comes from behind, several times as well.
  EXPECT_NEAR(with.row(0).sum() / without.row(0).sum(), 1.0F,
              0.1F);  // a lobe of roughness .3 keeps to half angles where the term is within a tenth
  EXPECT_GT(with.row(1).sum() / without.row(1).sum(), 2.0F);
}

TEST(Transport, HorizonCutsWhatItShould) {
  const SphereGrid grid(16);
  Observations one;
  one.resize(1);
  one.normal.row(0) = Eigen::RowVector3f(0, 0, 1);
  one.view.row(0) = Eigen::RowVector3f(0, 0, 1);
  // A wall to the right whose top is 45 degrees up, nothing elsewhere.
  one.horizon.setConstant(1, kHorizonAzimuths, -1e6F);
  for (const int a : {kHorizonAzimuths - 2, kHorizonAzimuths - 1, 0, 1, 2}) one.horizon(0, a) = 1.0F;
  const RowMatrix rows = build_transport(one, grid).diffuse();
  EXPECT_EQ(rows(0, grid.cell_of(Eigen::Vector3f(1, 0, 0.7F))), 0.0F);
  EXPECT_GT(rows(0, grid.cell_of(Eigen::Vector3f(1, 0, 1.6F))), 0.0F);
  EXPECT_GT(rows(0, grid.cell_of(Eigen::Vector3f(-1, 0, 0.7F))), 0.0F);
}

TEST(Transport, OpenRowsAreWithoutTheHorizonAndLeaveTheHighlights) {
  const SphereGrid grid(4);
  const Observations bare = testing::ellipsoid_face(12);
  Observations face = bare;
  face.horizon.setConstant(face.count(), kHorizonAzimuths, 0.3F);
  const Transport shadowed = build_transport(face, grid);
  const Transport open = build_transport(face, grid, 0, Fresnel::kSchlick, DiffuseRows::kOpenShading);
  EXPECT_TRUE(open.diffuse() == build_transport(bare, grid).diffuse());
  EXPECT_TRUE(open.highlight() == shadowed.highlight());
  EXPECT_FALSE(open.diffuse() == shadowed.diffuse());
}

TEST(Transport, SameForAnyNumberOfThreads) {
  const SphereGrid grid(4);
  const Observations face = testing::ellipsoid_face(12);
  EXPECT_TRUE(build_transport(face, grid, 1).highlight() == build_transport(face, grid, 3).highlight());
}

TEST(Transport, RefusesBrokenObservations) {
  Observations face = testing::ellipsoid_face(8);
  face.roughness[0] = 0.0F;
  EXPECT_THROW(build_transport(face, SphereGrid(2)), std::invalid_argument);
  face = testing::ellipsoid_face(8);
  face.highlight(0, 0) = std::nanf("");
  EXPECT_THROW(build_transport(face, SphereGrid(2)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting

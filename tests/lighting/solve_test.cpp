#include "faceprobe/lighting/estimate.h"

#include "faceprobe/core/error.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace faceprobe::lighting {
namespace {

using testing::brightest_direction;
using testing::ellipsoid_face;
using testing::lamp;
using testing::light_up;

// What the layers here deserve: they are exact.
SolveOptions for_exact_layers(int iterations = 50) {
  SolveOptions options;
  options.highlight_weight = 1;
  options.prior_weight = 0;
  options.iterations = iterations;
  return options;
}

TEST(Solve, OneLampComesBackWithinOneCell) {
  const SphereGrid grid(16);
  for (const Solver solver : {Solver::kTransport, Solver::kPaper}) {
    for (const auto& [azimuth, elevation] : {std::pair{0.0, 20.0}, {45.0, 10.0}, {-30.0, 45.0}, {70.0, -20.0}}) {
      Observations face = ellipsoid_face();
      const Eigen::Vector3d truth =
          grid.direction(grid.cell_of(direction_from_angles(azimuth, elevation).cast<float>())).cast<double>();
      light_up(face, grid, lamp(grid, truth, 1, 0.01F));
      SolveOptions options = for_exact_layers(200);
      options.solver = solver;
      const Light light = solve(face, options);
      // The exact model: the cell itself or a neighbour, whose centre is at most 5.4 degrees away. The paper's Phong lobe has no
      // Fresnel term, which pulls lights at 70 degrees outwards by several cells.
      EXPECT_LE(angle_between_deg(brightest_direction(light.radiance, grid), truth), solver == Solver::kPaper ? 20 : 5.4)
          << solver_name(solver) << " azimuth " << azimuth << " elevation " << elevation;
    }
  }
}

TEST(Solve, PaperFindsALampWithinOneCellOfItsOwnModel) {
  // The paper's model exactly: highlight = (R . L)^alpha, no Fresnel, no shadowing.
  const SphereGrid grid(16);
  Observations face = ellipsoid_face(60);
  const Eigen::Vector3f truth = grid.direction(grid.cell_of(direction_from_angles(40, 20).cast<float>()));
  for (Eigen::Index i = 0; i < face.count(); ++i) {
    const Eigen::Vector3f n = face.normal.row(i).transpose();
    const Eigen::Vector3f mirrored = 2 * n.z() * n - Eigen::Vector3f::UnitZ();
    face.highlight.row(i).setConstant(std::pow(std::max(0.0F, mirrored.dot(truth)), 5.06F));  // m = .3
  }
  const Light light = solve(face, {.solver = Solver::kPaper, .iterations = 100});
  EXPECT_LE(angle_between_deg(brightest_direction(light.radiance, grid), truth.cast<double>()), 3.8);
}

TEST(Solve, UniformLightComesBackUniform) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  light_up(face, grid, Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 1.5F));
  const Light light = solve(face, {});
  for (int j = 0; j < grid.cell_count(); ++j) {
    // The start is uniform already; the fitted gain and leak may tilt the highlights by a few percent.
    EXPECT_NEAR(light.radiance(j, 1), 1.5F, 0.12F);
  }
}

TEST(Solve, TurningTheLightTurnsTheAnswer) {
  const SphereGrid grid(16);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(radians(70), Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Vector3d before = direction_from_angles(-40, 25);
  Observations face = ellipsoid_face();
  light_up(face, grid, lamp(grid, before, 8, 0.05F));
  const Eigen::Vector3d first = brightest_direction(solve(face, {}).radiance, grid);
  light_up(face, grid, lamp(grid, turn * before, 8, 0.05F));
  const Eigen::Vector3d second = brightest_direction(solve(face, {}).radiance, grid);
  EXPECT_LT(angle_between_deg(turn * first, second),
            10);  // the disc is 16 degrees wide; its brightest cell is anywhere in it
}

TEST(Solve, ScaleAndColourOfTheLightCarryOver) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  const Eigen::MatrixX3f map = lamp(grid, {0.4, 0.5, 0.8}, 12, 0.2F, {1.5F, 1, 0.6F});
  light_up(face, grid, map);
  const Light once = solve(face, {});
  const Eigen::RowVector3f energy = once.radiance.colwise().sum();
  const Eigen::RowVector3f truth = map.colwise().sum();
  EXPECT_NEAR(energy[0] / energy[2], truth[0] / truth[2], 0.1F * truth[0] / truth[2]);
  light_up(face, grid, 4.0F * map);
  const Light brighter = solve(face, {});
  EXPECT_NEAR(brighter.radiance.sum() / once.radiance.sum(), 4.0F, 0.01F);
}

TEST(Solve, GainBetweenHighlightsAndShadingIsFound) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  light_up(face, grid, lamp(grid, {0.4, 0.5, 0.8}, 12, 0.2F));
  face.highlight *= 3.0F;
  const Light light = solve(face, {});
  // The light it is fitted against is ten smooth iterations of the shading: right in the sum to about a quarter.
  EXPECT_NEAR(light.highlight_gain, 3.0F, 0.75F);
}

TEST(Solve, ConfidenceFallsFromFrontToBack) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  light_up(face, grid, lamp(grid, {0, 0.5, 1}, 12, 0.2F));
  const Light light = solve(face, {});
  EXPECT_GT(light.confidence[grid.cell_of({0, 0, 1})], 0.5F);
  EXPECT_LT(light.confidence[grid.cell_of({0, 0, -1})], 0.05F);
  EXPECT_TRUE(light.radiance.row(grid.cell_of({0, 0, -1})).isApprox(light.ambient.transpose(), 0.05F));
}

TEST(Solve, WhatIsExpectedStaysWhereNothingIsObserved) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  const Eigen::MatrixX3f map = lamp(grid, {0.4, 0.5, 0.8}, 12, 0.2F);
  light_up(face, grid, map);
  // Right but for a blue lamp behind the head, which no patch sees.
  const Eigen::MatrixX3f expected = map + lamp(grid, {0, 0, -1}, 10, 0.0F, {0.2F, 0.5F, 1});
  const Light light = solve(face, {}, expected);
  const int behind = grid.cell_of({0, 0, -1});
  EXPECT_TRUE(light.radiance.row(behind).isApprox(expected.row(behind), 0.05F));  // the scale is fitted
  EXPECT_LT(light.confidence[behind], 0.05F);
}

TEST(Solve, WhatIsObservedOverrulesWhatIsExpected) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  const Eigen::Vector3d towards = direction_from_angles(40, 20);
  light_up(face, grid, lamp(grid, towards, 8, 0.05F));
  const Eigen::MatrixX3f wrong = lamp(grid, direction_from_angles(-30, 0), 15, 0.3F);
  SolveOptions options;
  options.iterations = 200;  // to walk away from the wrong lamp
  const Light light = solve(face, options, wrong);
  EXPECT_LT(angle_between_deg(brightest_direction(light.radiance, grid), towards), 10);  // the disc is 16 degrees wide
}

TEST(Solve, TheScaleOfWhatIsExpectedDoesNotMatter) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face();
  const Eigen::MatrixX3f map = lamp(grid, {0.4, 0.5, 0.8}, 12, 0.2F);
  light_up(face, grid, map);
  const Light once = solve(face, {}, map);
  const Light more = solve(face, {}, 7 * map);
  EXPECT_LT((once.radiance - more.radiance).norm() / once.radiance.norm(), 1e-3F);  // float
  EXPECT_THROW(solve(face, {}, Eigen::MatrixX3f::Ones(5, 3)), std::invalid_argument);
  EXPECT_THROW(solve(face, {}, -map), std::invalid_argument);
}

TEST(Solve, ClippedPixelsAreBoundsNotData) {
  const SphereGrid grid(16);
  const Eigen::MatrixX3f map = lamp(grid, {0.2, 0.5, 0.9}, 5, 0.1F);
  Observations face = ellipsoid_face();
  light_up(face, grid, map);
  const float limit = 0.3F * face.highlight.maxCoeff();
  Observations believed = face;
  believed.highlight = face.highlight.cwiseMin(limit);
  Observations marked = believed;
  marked.clipped = face.highlight.array() > limit;
  SolveOptions options = for_exact_layers();
  options.shading_weight = 0.05F;
  const auto peak = [&](const Observations& o) { return solve(o, options).radiance.maxCoeff(); };
  EXPECT_GT(peak(marked), 1.3F * peak(believed));
}

TEST(Solve, NoHighlightsNoShadingNoPixels) {
  const SphereGrid grid(16);
  Observations face = ellipsoid_face(16);
  light_up(face, grid, lamp(grid, direction_from_angles(50, 20), 12, 0.2F));
  face.highlight.setZero();
  const Light shading_only = solve(face, {});
  EXPECT_LT(angle_between_deg(brightest_direction(shading_only.radiance, grid), direction_from_angles(50, 20)), 25);
  face.shading.setZero();
  const Light nothing = solve(face, {});
  EXPECT_TRUE(nothing.radiance.isZero());
  EXPECT_TRUE(nothing.confidence.isZero());
  Observations none;
  none.resize(0);
  for (const Solver solver : {Solver::kTransport, Solver::kPaper}) {
    EXPECT_TRUE(solve(none, {.solver = solver}).radiance.allFinite());
  }
}

TEST(Solve, BitwiseTheSameForAnyNumberOfThreads) {
  const SphereGrid grid(8);
  Observations face = ellipsoid_face(20);
  light_up(face, grid, lamp(grid, {0.4, 0.5, 0.8}, 12, 0.2F), 0.05F);
  for (const Solver solver : {Solver::kTransport, Solver::kPaper}) {
    const Eigen::MatrixX3f one = solve(face, {.solver = solver, .nside = 8, .threads = 1}).radiance;
    EXPECT_TRUE(one == solve(face, {.solver = solver, .nside = 8, .threads = 4}).radiance);
  }
}

TEST(Solve, NamesAndOptionsAreChecked) {
  EXPECT_EQ(solver_from_name("paper"), Solver::kPaper);
  EXPECT_THROW(solver_from_name("magic"), Error);
  EXPECT_THROW(solve(ellipsoid_face(8), {.nside = 1}), std::invalid_argument);
  EXPECT_THROW(solve(ellipsoid_face(8), {.iterations = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting

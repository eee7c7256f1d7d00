// Other ways from a face to the light, on faces whose light is known.
#include "face_light_methods.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "paper/light_direction.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::cli::testing {
namespace {

using faceprobe::testing::TempFolder;

constexpr int kNside = 16;
const Eigen::Vector3f kLamp = Eigen::Vector3f(0.5F, 0.3F, 0.8F).normalized();

// Patches that face everywhere alike, seen from +z, under one lamp without shadows: shading, and no highlights.
pipeline::FaceEstimate ball_under_lamp() {
  pipeline::FaceEstimate ball;
  const SphereGrid faces(8);
  lighting::Observations& o = ball.observations;
  o.resize(faces.cell_count());
  for (int i = 0; i < faces.cell_count(); ++i) {
    o.normal.row(i) = faces.direction(i).transpose();
    o.view.row(i) = Eigen::RowVector3f::UnitZ();
    o.shading.row(i).setConstant(std::max(0.0F, faces.direction(i).dot(kLamp)));
  }
  return ball;
}

double off_deg(const Eigen::MatrixX3f& light) {
  const std::vector<Eigen::Vector3d> lights = light_directions(result_of(light));
  return lights.empty() ? 180 : angle_between_deg(lights[0], kLamp.cast<double>());
}

TEST(HarmonicsOfShading, PointAtTheLamp) {
  const pipeline::FaceEstimate ball = ball_under_lamp();
  const Eigen::MatrixX3f light = harmonics_of_shading(kNside).light({ball, {}});
  ASSERT_EQ(light.rows(), SphereGrid(kNside).cell_count());
  // Patches are as many all around the lamp, so its harmonics are even about it, up to the grids' cells.
  EXPECT_LT(off_deg(light), degrees(SphereGrid(8).cell_radius()));
}

TEST(LampAtTheBrightestHighlight, IsWhereThatMirrors) {
  pipeline::FaceEstimate ball = ball_under_lamp();
  const Eigen::Vector3f half = (kLamp + Eigen::Vector3f::UnitZ()).normalized();
  Eigen::Index brightest = 0;
  (ball.observations.normal * half).maxCoeff(&brightest);
  ball.observations.highlight.row(brightest).setConstant(2);
  ball.observations.highlight.row((brightest + 7) % ball.observations.count()).setConstant(1);
  const Eigen::MatrixX3f light = lamp_at_brightest_highlight(kNside).light({ball, {}});
  // Cells are no discs: their corners are half as far again as their radius. Mirroring doubles how far a patch is off the half vector.
  EXPECT_LT(off_deg(light), degrees(1.5 * (2 * SphereGrid(8).cell_radius() + SphereGrid(kNside).cell_radius())));
}

TEST(LampAtTheBrightestHighlight, NeedsAHighlight) {
  const pipeline::FaceEstimate ball = ball_under_lamp();
  EXPECT_EQ(lamp_at_brightest_highlight(kNside).light({ball, {}}).size(), 0);
  EXPECT_EQ(lamp_at_brightest_highlight(kNside).light({pipeline::FaceEstimate(), {}}).size(), 0);
}

TEST(JointEstimate, FillsTheGridThatIsAskedFor) {
  pipeline::FaceEstimate ball = ball_under_lamp();
  lighting::Observations& seen = ball.observations;
  seen.weight = (seen.normal.col(2).array() > 0).cast<float>();
  const Eigen::MatrixX3f light = joint_estimate(kNside, 1).light({ball, {}});
  ASSERT_EQ(light.rows(), SphereGrid(kNside).cell_count());
  // On the lamp's side: its prior of gradients spreads a lamp over tens of degrees.
  EXPECT_LT(off_deg(light), 45);
}

TEST(LearntTransfer, IsNothingWithoutTracedPhotos) {
  const TempFolder folder;
  EXPECT_FALSE(learnt_transfer(folder.path(), kNside));
}

TEST(ConstantLight, SaysThatItIsOne) {
  const FaceLightMethod mean = constant_light("mean", Eigen::MatrixX3f::Ones(12, 3));
  EXPECT_TRUE(mean.constant);
  EXPECT_FALSE(harmonics_of_shading(kNside).constant);
  EXPECT_EQ(mean.light({pipeline::FaceEstimate(), {}}), Eigen::MatrixX3f(Eigen::MatrixX3f::Ones(12, 3)));
}

}  // namespace
}  // namespace faceprobe::cli::testing

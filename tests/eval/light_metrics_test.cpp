#include "faceprobe/eval/light_metrics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace faceprobe::eval {
namespace {

struct LightMetricsTest : public ::testing::Test {
  SphereGrid grid{16};
  LitObject sphere{sphere_mesh(48), {.size_px = 32}};

  // Even light with one lamp of three cells' radius.
  Eigen::MatrixX3f lamp(const Eigen::Vector3f& direction, const Eigen::RowVector3f& colour, float strength) const {
    Eigen::MatrixX3f light(grid.cell_count(), 3);
    light.rowwise() = 0.1F * colour;
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (grid.direction(j).dot(direction.normalized()) > 0.98F) light.row(j) += strength * colour;
    }
    return light;
  }
};

TEST_F(LightMetricsTest, TheScaleOfALightDoesNotMatter) {
  const Eigen::MatrixX3f truth = lamp({1, 1, 2}, {1, 0.9F, 0.7F}, 30);
  const Eigen::MatrixX3f more = 3 * truth;
  // What is left is float rounding.
  EXPECT_NEAR(relight_error(sphere, truth, more).diffuse, 0, 1e-3);
  EXPECT_NEAR(relight_error(sphere, truth, more).glossy, 0, 1e-3);
  const SphereError mirror = sphere_error(truth, more, grid, render::SphereMaterial::kMirror);
  EXPECT_NEAR(mirror.si_rmse, 0, 1e-5);
  EXPECT_NEAR(mirror.angular_deg, 0, 0.05);
  EXPECT_NEAR(mirror.nrmse, 0, 1e-5);
  EXPECT_NEAR(map_error(truth, more).over_truth_range, 0, 1e-6);
  EXPECT_NEAR(main_light_error_deg(truth, more, grid), 0, 1e-3);
  EXPECT_NEAR(light_colour_error_deg(truth, more), 0, 1e-3);
}

// Both pictures have 1 where they are brightest; on a ball lit from the side the rest is max(0, N.L), from the front max(0, N.V).
TEST_F(LightMetricsTest, ABallLitFromTheWrongSideIsOffByWhatTheCosinesSay) {
  Eigen::MatrixX3f right = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  Eigen::MatrixX3f front = right;
  const int right_cell = grid.cell_of({1, 0, 0});
  const int front_cell = grid.cell_of({0, 0, 1});
  right.row(right_cell).setOnes();
  front.row(front_cell).setOnes();
  double sum = 0;
  double count = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const double u = (x + 0.5) / 200 - 1;
      const double v = 1 - (y + 0.5) / 200;
      if (u * u + v * v >= 1) continue;
      const Eigen::Vector3d n(u, v, std::sqrt(1 - u * u - v * v));
      const double a = std::max(0.0, n.dot(grid.direction(right_cell).cast<double>()));
      const double b = std::max(0.0, n.dot(grid.direction(front_cell).cast<double>()));
      sum += (a - b) * (a - b);
      ++count;
    }
  }
  EXPECT_NEAR(relight_error(sphere, right, front).diffuse, 255 * std::sqrt(sum / count),
              5);  // 32 px, and facets of four degrees on the rim
}

TEST_F(LightMetricsTest, MapErrorIsThatOfMapsWithOneMean) {
  const SphereGrid small(2);  // 48 cells
  Eigen::MatrixX3f truth = Eigen::MatrixX3f::Zero(48, 3);
  truth.row(5).setConstant(7);
  const Eigen::MatrixX3f even = Eigen::MatrixX3f::Constant(48, 3, 0.3F);
  // One cell has 48 instead of 1, 47 have 0 instead of 1; the truth's range is 48.
  EXPECT_NEAR(map_error(truth, even).over_truth_range, std::sqrt((47.0 * 47 + 47) / 48) / 48, 1e-5);
  EXPECT_NEAR(map_error(even, truth).over_estimate_range, std::sqrt((47.0 * 47 + 47) / 48) / 48, 1e-5);
}

TEST_F(LightMetricsTest, TheMainLightIsOffByTheTurn) {
  const Eigen::Vector3f direction = Eigen::Vector3f(0.3F, 0.5F, 0.8F).normalized();
  const Eigen::Vector3f axis = direction.unitOrthogonal();
  const Eigen::MatrixX3f truth = lamp(direction, {1, 1, 1}, 40);
  for (const float turn_deg : {10.0F, 35.0F, 120.0F}) {
    const Eigen::Vector3f turned = Eigen::AngleAxisf(turn_deg * 0.0174532925F, axis) * direction;
    EXPECT_NEAR(main_light_error_deg(truth, lamp(turned, {1, 1, 1}, 40), grid), turn_deg,
                2);  // half a cell at each end
  }
  EXPECT_TRUE(has_dominant_light(truth, grid));
  EXPECT_FALSE(has_dominant_light(truth + lamp({-1, 0, 1}, {1, 1, 1}, 40), grid));
  EXPECT_FALSE(has_dominant_light(Eigen::MatrixX3f::Ones(grid.cell_count(), 3), grid));
}

TEST_F(LightMetricsTest, ColoursWithoutACommonChannelAreARightAngleApart) {
  Eigen::MatrixX3f red = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  Eigen::MatrixX3f green = red;
  red.col(0).setOnes();
  green.col(1).setOnes();
  EXPECT_NEAR(light_colour_error_deg(red, green), 90, 1e-6);
  EXPECT_NEAR(sphere_error(red, green, grid, render::SphereMaterial::kDiffuse).angular_deg, 90, 1e-3);
}

TEST_F(LightMetricsTest, ABlackLightIsNoNumber) {
  const Eigen::MatrixX3f truth = lamp({0, 0, 1}, {1, 1, 1}, 10);
  const Eigen::MatrixX3f black = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  EXPECT_TRUE(std::isnan(relight_error(sphere, truth, black).diffuse));
  EXPECT_TRUE(std::isnan(sphere_error(truth, black, grid, render::SphereMaterial::kMatte).si_rmse));
  EXPECT_TRUE(std::isnan(map_error(truth, black).over_truth_range));
  EXPECT_TRUE(std::isnan(main_light_error_deg(truth, black, grid)));
  // Even light comes from nowhere: its first cell, the pole, is no answer.
  EXPECT_TRUE(std::isnan(main_light_error_deg(truth, Eigen::MatrixX3f::Ones(grid.cell_count(), 3), grid)));
  EXPECT_TRUE(std::isnan(light_colour_error_deg(truth, black)));
}

}  // namespace
}  // namespace faceprobe::eval

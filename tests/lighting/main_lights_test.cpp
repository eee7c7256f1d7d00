#include "faceprobe/lighting/main_lights.h"

#include "synthetic_face.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

using testing::lamp;

TEST(MainLights, OneDiscIsFoundWithItsDirectionSizeColourAndShare) {
  const SphereGrid grid(32);
  const Eigen::Vector3d direction = direction_from_angles(-40, 35);
  const std::vector<MainLight> lights = main_lights(lamp(grid, direction, 10, 0.05F, {2, 1, 0.5F}), grid);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_LT(angle_between_deg(lights[0].direction, direction), 1.0);  // half a cell of nside 32
  EXPECT_NEAR(lights[0].solid_angle_sr, 2 * kPi * (1 - std::cos(radians(10))), 0.01);
  EXPECT_NEAR(lights[0].colour[0] / lights[0].colour[2], 4.0, 0.1);
  EXPECT_NEAR(0.2126 * lights[0].colour[0] + 0.7152 * lights[0].colour[1] + 0.0722 * lights[0].colour[2], 1.0, 1e-9);
  const double disc = 0.2126 * 2 + 0.7152 + 0.0722 * 0.5;
  EXPECT_NEAR(lights[0].irradiance, disc, 0.02);
  EXPECT_NEAR(lights[0].share, disc / (disc + 0.05 * 4 * kPi), 0.02);
}

TEST(MainLights, SeveralComeByStrengthAndTwinsMerge) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f map = lamp(grid, direction_from_angles(60, 20), 6, 0.02F);
  map += 2.0F * lamp(grid, direction_from_angles(-60, 10), 6, 0.0F);
  map += 0.5F * lamp(grid, direction_from_angles(-50, 15), 6, 0.0F);  // 11 degrees from the strongest: one light
  const std::vector<MainLight> lights = main_lights(map, grid);
  ASSERT_EQ(lights.size(), 2U);
  EXPECT_LT(azimuth_deg(lights[0].direction), -45);
  EXPECT_NEAR(azimuth_deg(lights[1].direction), 60, 4);
  EXPECT_GT(lights[0].irradiance, lights[1].irradiance);
}

TEST(MainLights, PeaksThatNothingObservedAreNoLights) {
  const SphereGrid grid(8);
  const Eigen::MatrixX3f map =
      lamp(grid, direction_from_angles(60, 20), 10, 0.02F) + lamp(grid, direction_from_angles(-150, 0), 10, 0.0F);
  Eigen::VectorXf confidence = Eigen::VectorXf::Ones(grid.cell_count());
  for (int j = 0; j < grid.cell_count(); ++j) confidence[j] = grid.direction(j).z() > 0 ? 1.0F : 0.1F;
  EXPECT_EQ(main_lights(map, grid).size(), 2U);
  const std::vector<MainLight> lights = main_lights(map, grid, {}, confidence);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_NEAR(azimuth_deg(lights[0].direction), 60, 4);
}

TEST(MainLights, TheSlopeOfAHiddenGlowIsNoLight) {
  // A glow 20 degrees wide around a point 15 degrees behind the border of what is seen, and a lamp in view.
  const SphereGrid grid(16);
  Eigen::MatrixX3f map = lamp(grid, direction_from_angles(20, 30), 8, 0.05F);
  Eigen::VectorXf confidence(grid.cell_count());
  const Eigen::Vector3d middle = direction_from_angles(-105, 10);
  for (int j = 0; j < grid.cell_count(); ++j) {
    const double away = angle_between_deg(middle, grid.direction(j).cast<double>());
    map.row(j).array() += 5.0F * static_cast<float>(std::exp(-0.5 * away * away / 400));
    confidence[j] = grid.direction(j).z() > 0 ? 1.0F : 0.0F;
  }
  EXPECT_EQ(main_lights(map, grid).size(), 2U);
  const std::vector<MainLight> lights = main_lights(map, grid, {}, confidence);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_NEAR(azimuth_deg(lights[0].direction), 20, 4);
}

TEST(MainLights, EvenLightAndDarknessHaveNone) {
  const SphereGrid grid(8);
  EXPECT_TRUE(main_lights(Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.7F), grid).empty());
  EXPECT_TRUE(main_lights(Eigen::MatrixX3f::Zero(grid.cell_count(), 3), grid).empty());
}

TEST(MainLights, LampsOverTheRestIsARatioOfEnergies) {
  const SphereGrid grid(16);
  EXPECT_EQ(light_to_ambient_ratio({}), 0);
  // A lamp of irradiance 1 in a surround of radiance .05 has 1 to .05 x 4 pi; another one outside the list counts to the rest.
  const std::vector<MainLight> one = main_lights(lamp(grid, direction_from_angles(60, 20), 6, 0.05F), grid);
  EXPECT_NEAR(light_to_ambient_ratio(one), 1 / (0.05 * 4 * kPi), 0.05);
  Eigen::MatrixX3f map = lamp(grid, direction_from_angles(60, 20), 6, 0.05F);
  map += lamp(grid, direction_from_angles(-60, 20), 6, 0.0F);
  EXPECT_NEAR(light_to_ambient_ratio(main_lights(map, grid)), 2 / (0.05 * 4 * kPi), 0.1);
  EXPECT_NEAR(light_to_ambient_ratio(main_lights(map, grid, {.max_lights = 1})), 1 / (1 + 0.05 * 4 * kPi), 0.05);
  // Nothing but a lamp.
  EXPECT_GT(light_to_ambient_ratio(main_lights(lamp(grid, {0, 0, 1}, 6, 0.0F), grid)), 1e6);
}

TEST(MainLights, TheRestAndTheLampAreAllTheLight) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f map = lamp(grid, direction_from_angles(60, 20), 6, 0.02F, {1.4F, 1, 0.5F});
  map += 2.0F * lamp(grid, direction_from_angles(-60, 10), 6, 0.0F);
  const std::vector<MainLight> lights = main_lights(map, grid);
  ASSERT_EQ(lights.size(), 2U);
  const Eigen::MatrixX3f rest = without_main_lights(map, grid, 1);
  const Eigen::Vector3d whole = map.cast<double>().colwise().sum().transpose() * grid.cell_solid_angle();
  const Eigen::Vector3d left = rest.cast<double>().colwise().sum().transpose() * grid.cell_solid_angle();
  const Eigen::Vector3d lamp = lights[0].irradiance * lights[0].colour;
  EXPECT_LT((left + lamp - whole).cwiseAbs().maxCoeff(), 1e-4);  // float
  EXPECT_GE(rest.minCoeff(), 0);
  // The other one is what is brightest now; with both gone nothing is.
  const std::vector<MainLight> others = main_lights(rest, grid);
  ASSERT_EQ(others.size(), 1U);
  EXPECT_NEAR(azimuth_deg(others[0].direction), 60, 4);
  EXPECT_TRUE(main_lights(without_main_lights(map, grid, 5), grid).empty());
  EXPECT_EQ(without_main_lights(map, grid, 0), map);
}

}  // namespace
}  // namespace faceprobe::lighting

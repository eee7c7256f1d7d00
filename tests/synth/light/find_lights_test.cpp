#include "synth/light/find_lights.h"

#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

constexpr float kRadius = 0.04F;
constexpr double kTexelDeg = 360.0 / kTestWidth;

Eigen::Vector3d total(const FoundLights& found) {
  Eigen::Vector3d sum = found.rest.integral();
  for (const DistantLight& light : found.lights) sum += light.irradiance.cast<double>();
  return sum;
}

TEST(FindLights, ASingleTexelIsFoundWhereItIs) {
  for (const auto& [x, y] :
       {std::pair{64, 64}, std::pair{0, 30}, std::pair{255, 100}, std::pair{17, 0}, std::pair{200, 127}}) {
    EnvMap map = sky();
    const Eigen::Vector3d before = map.integral();
    for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = static_cast<float>(1e5 * (c + 1));
    const FoundLights found = find_lights(map, 6, kRadius);
    ASSERT_EQ(found.lights.size(), 1U) << x << ' ' << y;
    // The centre of the one texel; float rounding of the angle.
    EXPECT_LT(angle_between_deg(found.lights[0].direction.cast<double>(), map.direction(x, y).cast<double>()), 0.01);
    const double solid_angle = texel_solid_angle(y, kTestWidth, kTestWidth / 2);
    EXPECT_NEAR(found.lights[0].irradiance(1) / (2e5 * solid_angle), 1.0, 1e-4);
    // What is left is the sky: what was taken is at most the lamp and the difference of its surround from the median.
    EXPECT_LT((found.rest.integral() - before).norm(), 1e-3 * before.norm());
  }
}

TEST(FindLights, AllEnergyIsSomewhere) {
  EnvMap map = sky();
  add_lamp(map, Eigen::Vector3f(1, 1, 1).normalized(), 0.8, {5000, 4000, 3000});
  add_lamp(map, Eigen::Vector3f(-1, 0.3F, 1).normalized(), 1.2, {300, 100, 900});
  add_lamp(map, Eigen::Vector3f(0, 1, 0.001F).normalized(), 1.2, {900, 900, 900});
  const FoundLights found = find_lights(map, 6, kRadius);
  EXPECT_EQ(found.lights.size(), 3U);
  // Irradiance is kept as float: 6e-8 of the largest light.
  EXPECT_LT((total(found) - map.integral()).cwiseQuotient(map.integral()).cwiseAbs().maxCoeff(), 1e-6);
  for (std::size_t i = 0; i < map.radiance().values().size(); ++i) {
    ASSERT_LE(found.rest.radiance().values()[i], map.radiance().values()[i]);
    ASSERT_LT(found.rest.radiance().values()[i], 3.0F);  // the lamps are gone
  }
}

TEST(FindLights, ALampsDirectionIsItsMiddle) {
  for (const double radius_deg : {0.5, 1.0, 1.8}) {
    EnvMap map = sky();
    const Eigen::Vector3f direction = Eigen::Vector3f(0.3F, 0.5F, -0.7F).normalized();
    add_lamp(map, direction, radius_deg, {3000, 3000, 3000});
    const FoundLights found = find_lights(map, 6, kRadius);
    ASSERT_EQ(found.lights.size(), 1U) << radius_deg;
    EXPECT_LT(angle_between_deg(found.lights[0].direction.cast<double>(), direction.cast<double>()), 0.2 * kTexelDeg);
  }
}

TEST(FindLights, OvercastAndLargeLampsHaveNone) {
  EXPECT_TRUE(find_lights(sky(), 6, kRadius).lights.empty());
  EnvMap softbox = sky();
  add_lamp(softbox, Eigen::Vector3f(1, 0.5F, 1).normalized(), 12, {60, 60, 60});
  const FoundLights found = find_lights(softbox, 6, kRadius);
  EXPECT_TRUE(found.lights.empty());
  EXPECT_EQ(found.rest.radiance(), softbox.radiance());
}

TEST(FindLights, AStripIsNoDistantLight) {
  EnvMap map = sky();
  for (int x = 40; x < 90; ++x) {
    for (int c = 0; c < 3; ++c) map.radiance()(x, 40, c) += 400.0F;  // a tube, 70 degrees long
  }
  // Its two ends may pass for lamps; the tube itself may not.
  const FoundLights found = find_lights(map, 6, kRadius);
  EXPECT_GT(found.rest.integral()(1), 0.9 * map.integral()(1));
}

TEST(FindLights, WeakOnesAreNotWorthARay) {
  EnvMap map = sky();
  add_lamp(map, Eigen::Vector3f(1, 0, 1).normalized(), 1.0, {20, 20, 20});
  const double share = 20 * 2 * kPi * (1 - std::cos(radians(1.0))) / sky().integral()(1);
  ASSERT_LT(share, 0.01);
  EXPECT_TRUE(find_lights(map, 6, kRadius).lights.empty());
}

TEST(FindLights, NoMoreThanAllowedAndTheBrightestFirst) {
  EnvMap map = sky();
  for (int k = 0; k < 5; ++k) {
    add_lamp(map, direction_from_angles(-120 + 60 * k, 10).cast<float>(), 1.0,
             Eigen::Vector3f::Constant(1000.0F * static_cast<float>(k + 1)));
  }
  const FoundLights found = find_lights(map, 2, kRadius);
  ASSERT_EQ(found.lights.size(), 2U);
  EXPECT_NEAR(azimuth_deg(found.lights[0].direction.cast<double>()), 120, kTexelDeg);
  EXPECT_NEAR(azimuth_deg(found.lights[1].direction.cast<double>()), 60, kTexelDeg);
  EXPECT_TRUE(find_lights(map, 0, kRadius).lights.empty());
  EXPECT_EQ(find_lights(map, 6, kRadius).lights.size(), 5U);
}

TEST(FindLights, AGlaringSunIsOneLight) {
  EnvMap map = sky();
  const Eigen::Vector3f sun = direction_from_angles(-36, 30).cast<float>();
  add_lamp(map, sun, 0.5, {30000, 30000, 30000});
  add_lamp(map, sun, 2.0, {300, 300, 300});
  add_lamp(map, sun, 6.0, {3, 3, 3});
  const FoundLights found = find_lights(map, 6, kRadius);
  ASSERT_EQ(found.lights.size(), 1U);
  EXPECT_LT(angle_between_deg(found.lights[0].direction.cast<double>(), sun.cast<double>()), 0.2 * kTexelDeg);
}

}  // namespace
}  // namespace faceprobe::synth

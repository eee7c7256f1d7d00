#include "faceprobe/lighting/triangulate.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace faceprobe::lighting {
namespace {

// Three people before the camera, as in the paper's figure.
const std::vector<Eigen::Vector3d> kPlaces = {{-0.8, 0, -2.2}, {0.1, 0.1, -1.8}, {0.9, -0.05, -2.4}};

struct TrueLamp {
  Eigen::Vector3d position_m;
  double intensity;
  Eigen::Vector3d colour = Eigen::Vector3d::Ones();
};

MainLight seen_light(const Eigen::Vector3d& towards, double irradiance, const Eigen::Vector3d& colour) {
  MainLight light;
  light.direction = towards.normalized();
  light.irradiance = irradiance;
  light.colour = colour / luminance(colour.data());
  return light;
}

Eigen::Vector3d off_by(const Eigen::Vector3d& direction, double deviation_deg, Random& random) {
  const double s = radians(deviation_deg);
  return (direction.normalized() + Eigen::Vector3d(random.normal(0, s), random.normal(0, s), random.normal(0, s)))
      .normalized();
}

std::vector<FaceLights> look(const std::vector<TrueLamp>& lamps, double deviation_deg = 0, Random random = Random({1})) {
  std::vector<FaceLights> faces;
  for (const Eigen::Vector3d& place : kPlaces) {
    FaceLights face{place, 0.05, {}};
    for (const TrueLamp& lamp : lamps) {
      const Eigen::Vector3d offset = lamp.position_m - place;
      face.lights.push_back(
          seen_light(off_by(offset, deviation_deg, random), lamp.intensity / offset.squaredNorm(), lamp.colour));
    }
    std::stable_sort(face.lights.begin(), face.lights.end(),
                     [](const MainLight& a, const MainLight& b) { return a.irradiance > b.irradiance; });
    faces.push_back(face);
  }
  return faces;
}

std::vector<FaceLights> look_at_sun(const Eigen::Vector3d& towards, double deviation_deg, Random random) {
  std::vector<FaceLights> faces;
  for (const Eigen::Vector3d& place : kPlaces)
    faces.push_back({place, 0.05, {seen_light(off_by(towards, deviation_deg, random), 3, {1, 1, 1})}});
  return faces;
}

TEST(Triangulate, OneLampThatAllSeeRightIsWhereItStands) {
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(0.5, 1, -0.5), {-1.5, 0.5, -1}, {0, -0.4, -0.8}}) {
    const std::vector<Lamp> lamps = triangulate(look({{place, 2}}));
    ASSERT_EQ(lamps.size(), 1U);
    EXPECT_TRUE(lamps[0].near);
    EXPECT_LT((lamps[0].position_m - place).norm(), 1e-3);  // where the differences' step ends
    EXPECT_NEAR(lamps[0].intensity, 2, 0.01);
    EXPECT_EQ(lamps[0].seen.size(), 3U);
    EXPECT_LT(lamps[0].miss_deg, 0.1);
  }
}

// Of the same colour: only how the rays meet tells them apart.
TEST(Triangulate, TwoLampsOfOneColourAreNotMixedUp) {
  const Eigen::Vector3d left(-1.2, 0.8, -0.8);
  const Eigen::Vector3d right(1.3, 0.6, -0.6);
  const std::vector<Lamp> lamps = triangulate(look({{left, 2}, {right, 3}}));
  ASSERT_EQ(lamps.size(), 2U);
  EXPECT_LT((lamps[0].position_m - right).norm(), 0.01);
  EXPECT_LT((lamps[1].position_m - left).norm(), 0.01);
}

TEST(Triangulate, ColoursKeepLampsApartThatStandClose) {
  const Eigen::Vector3d red(0.1, 1, -0.5);
  const Eigen::Vector3d blue(0.3, 0.9, -0.4);
  const std::vector<Lamp> lamps = triangulate(look({{red, 2, {2, 0.6, 0.5}}, {blue, 2, {0.5, 0.7, 2}}}));
  ASSERT_EQ(lamps.size(), 2U);
  for (const Lamp& lamp : lamps) {
    const bool is_red = lamp.colour[0] > lamp.colour[2];
    EXPECT_LT((lamp.position_m - (is_red ? red : blue)).norm(), 0.01);
  }
}

TEST(Triangulate, TheSunIsDistantHoweverTheDirectionsScatter) {
  int near = 0;
  int found = 0;
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    const std::vector<Lamp> lamps =
        triangulate(look_at_sun({0.4, 0.8, 0.6}, 8, Random({5, static_cast<std::uint64_t>(i)})));
    for (const Lamp& lamp : lamps) near += lamp.near ? 1 : 0;
    found += lamps.empty() ? 0 : 1;
  }
  EXPECT_GT(found, 90);
  // A gain of 4 by the one number more that a near lamp has is passed by chance in 5 of 100; the sum is not exactly of that kind.
  EXPECT_LE(near, 15);
}

// Scatter as assumed: the truth is inside the ellipsoid of three deviations' worth as often as it should be.
TEST(Triangulate, StatedUncertaintyCoversTheTruth) {
  const Eigen::Vector3d place(0.4, 0.9, -0.6);
  int inside = 0, found = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<Lamp> lamps = triangulate(look({{place, 2}}, 6, Random({7, static_cast<std::uint64_t>(i)})),
                                                {.direction_error_deg = 6, .max_miss_deg = 40, .least_gain = 0});
    if (lamps.empty() || !lamps[0].near) continue;
    ++found;
    const Eigen::Vector3d off = lamps[0].position_m - place;
    const double squared = off.dot(lamps[0].covariance_m2.inverse() * off);
    inside += squared < 7.81 ? 1 : 0;  // 95 % of a chi-square of three
  }
  EXPECT_GT(found, 80);
  EXPECT_GE(inside, 0.85 * found);  // 95 % but for what is not linear, and the spread of a hundred tries
}

TEST(Triangulate, ALightThatNobodyElseSeesIsNoLamp) {
  std::vector<FaceLights> faces = look({{{0.4, 0.9, -0.6}, 2}});
  faces[1].lights.push_back(seen_light({-1, -0.5, 0.2}, 1, {1, 1, 1}));
  const std::vector<Lamp> lamps = triangulate(faces);
  ASSERT_EQ(lamps.size(), 1U);
  for (const Sighting& s : lamps[0].seen) EXPECT_EQ(s.light, 0);
  EXPECT_TRUE(triangulate({faces[1]}).empty());
  EXPECT_TRUE(triangulate({}).empty());
}

TEST(Triangulate, RefusesOptionsThatMakeNoSense) {
  EXPECT_THROW(triangulate({}, {.direction_error_deg = 0}), std::invalid_argument);
  EXPECT_THROW(triangulate({}, {.least_m = 2, .most_m = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting

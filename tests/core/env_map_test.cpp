#include "faceprobe/core/env_map.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <stdexcept>

namespace faceprobe {
namespace {

TEST(EnvMap, DirectionAndPixelAreInverseOnEveryTexel) {
  const EnvMap map(256, 128);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3f d = map.direction(x, y);
      const Eigen::Vector3f back = direction_from_uv(uv_from_direction(d));
      ASSERT_LE(radians(angle_between_deg(d.cast<double>(), back.cast<double>())), 1e-5) << x << ' ' << y;
      const Eigen::Vector2f uv = uv_from_direction(d);
      ASSERT_EQ(static_cast<int>(uv.x() * 256), x);
      ASSERT_EQ(static_cast<int>(uv.y() * 128), y);
    }
  }
}

TEST(EnvMap, FrameIsTheOneWrittenDown) {
  EXPECT_TRUE(direction_from_uv({0.5F, 0.5F}).isApprox(Eigen::Vector3f(0, 0, 1), 1e-6F));   // centre: behind the camera
  EXPECT_TRUE(direction_from_uv({0.25F, 0.5F}).isApprox(Eigen::Vector3f(1, 0, 0), 1e-6F));  // right of the photo
  EXPECT_TRUE(direction_from_uv({0.3F, 0.0F}).isApprox(Eigen::Vector3f(0, 1, 0), 1e-6F));   // row 0: up
}

TEST(EnvMap, SolidAnglesFillTheSphere) {
  for (const int height : {1, 2, 7, 128, 1000}) {
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += 2 * height * texel_solid_angle(y, 2 * height, height);
    EXPECT_NEAR(sum, 4 * kPi, 1e-6) << height;
  }
}

TEST(EnvMap, DensityIsTheJacobianOfTheMapping) {
  const float h = 1e-3F;
  for (const float v : {0.05F, 0.3F, 0.5F, 0.9F}) {
    const Eigen::Vector3f du = (direction_from_uv({0.4F + h, v}) - direction_from_uv({0.4F - h, v})) / (2 * h);
    const Eigen::Vector3f dv = (direction_from_uv({0.4F, v + h}) - direction_from_uv({0.4F, v - h})) / (2 * h);
    // Central differences leave h^2 / 6 of the third derivative, (2 pi)^3 / 6 h^2 = 4e-5, and float rounding 1e-7 / h.
    EXPECT_NEAR(du.cross(dv).norm(), solid_angle_density(v), 5e-3F) << v;
  }
}

TEST(EnvMap, SampleAtTexelCentresReturnsTheTexelsAlsoAtSeamAndPoles) {
  EnvMap map(16, 8);
  for (std::size_t i = 0; i < map.radiance().values().size(); ++i) {
    map.radiance().values()[i] = static_cast<float>((i * 37) % 101);
  }
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Eigen::Map<const Eigen::Vector3f> texel(map.radiance().pixel(x, y));
      // Float rounding of the direction moves the look-up by 1e-6 of a texel, whose neighbours differ by up to 101.
      EXPECT_LE((map.sample(map.direction(x, y)) - texel).cwiseAbs().maxCoeff(), 1e-3F);
    }
  }
}

TEST(EnvMap, SampleIsContinuousOverThePole) {
  EnvMap map(32, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) map.radiance()(x, y, 0) = map.direction(x, y).x() + 2;
  }
  const float before = map.sample(Eigen::Vector3f(1e-4F, 1, 1e-4F))[0];
  const float after = map.sample(Eigen::Vector3f(-1e-4F, 1, -1e-4F))[0];
  EXPECT_NEAR(before, after, 1e-3F);
}

TEST(EnvMap, RotationMovesALampAndKeepsItsEnergy) {
  EnvMap map(128, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const double angle = angle_between_deg(map.direction(x, y).cast<double>(), {1, 0, 0});
      map.radiance()(x, y, 0) = static_cast<float>(std::exp(-angle * angle / 200));
    }
  }
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(kPi / 2), Eigen::Vector3f::UnitY()).toRotationMatrix();
  const EnvMap turned = rotate(map, turn);  // +x goes to -z
  EXPECT_GT(turned.sample({0, 0, -1})[0], 0.95F);
  EXPECT_LT(turned.sample({1, 0, 0})[0], 0.01F);
  // Bilinear look-up keeps the integral of a lobe four texels wide to better than a percent.
  EXPECT_NEAR(turned.integral()[0] / map.integral()[0], 1.0, 0.01);
}

TEST(EnvMap, AreaAverageKeepsTheIntegral) {
  EnvMap map(64, 32);
  map.radiance()(17, 3, 1) = 100.0F;  // one texel near the pole: the hard case
  EXPECT_NEAR(resize(map, 16, 8).integral()[1] / map.integral()[1], 1.0, 1e-5);  // float storage
  EXPECT_NEAR(resize(map, 40, 20).integral()[1] / map.integral()[1], 1.0, 0.2);  // rows split unevenly near the pole
}

TEST(EnvMap, RollsAreExactAndUndone) {
  EnvMap map(64, 32);
  map.radiance()(16, 16, 0) = 1.0F;  // u = .25 + half a texel: camera right
  EXPECT_EQ(to_orientation(map, Orientation::kThree).radiance()(32, 16, 0), 1.0F);
  EXPECT_EQ(to_orientation(map, Orientation::kDebevec).radiance()(48, 16, 0), 1.0F);
  for (const Orientation o : {Orientation::kOpenExr, Orientation::kThree, Orientation::kDebevec}) {
    EXPECT_EQ(from_orientation(to_orientation(map, o), o).radiance(), map.radiance());
  }
}

TEST(EnvMap, RefusesOtherShapes) {
  EXPECT_THROW(EnvMap(100, 60), std::invalid_argument);
  EXPECT_THROW(EnvMap(0, 0), std::invalid_argument);
  EXPECT_THROW(EnvMap(Image(64, 32, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe

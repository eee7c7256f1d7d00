#include "faceprobe/synth/map_light.h"
#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

EnvMap sunny(const Eigen::Vector3f& sun) {
  EnvMap map = sky();
  add_lamp(map, sun, 0.6, {9000, 8000, 6000});
  return map;
}

TEST(MapInFrame, KeepsEnergyTimesGainAtEverySize) {
  const EnvMap map = sunny(Eigen::Vector3f(1, 1, 1).normalized());
  const MapLight light = prepare_map("x", map, {});
  const Eigen::Vector3f gain(0.5F, 2.0F, 3.0F);
  for (const int height : {8, 16, 32, 64, 128}) {
    const EnvMap turned = map_in_frame(light, some_rotation(), gain, 2 * height, height);
    EXPECT_EQ(turned.height(), height);
    const Eigen::Vector3d expected = map.integral().cwiseProduct(gain.cast<double>());
    EXPECT_LT((turned.integral() - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-6)
        << height;  // float texels
  }
}

TEST(MapInFrame, TheSunIsWhereItWasTurnedTo) {
  // Anywhere, and at the target's pole and seam, where texels are narrow and rows wrap.
  for (const Eigen::Vector3f& target :
       {Eigen::Vector3f(0.4F, 0.2F, 0.7F), Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0.01F, -1, 0.02F),
        Eigen::Vector3f(0, 0.1F, -1), Eigen::Vector3f(1e-3F, 0, -1)}) {
    const Eigen::Vector3f sun = Eigen::Vector3f(1, 1, 1).normalized();
    const Eigen::Matrix3f turn = Eigen::Quaternionf::FromTwoVectors(sun, target.normalized()).toRotationMatrix();
    const EnvMap dark = [&] {
      EnvMap map(kTestWidth, kTestWidth / 2);
      for (float& value : map.radiance().values()) value = 1e-4F;
      add_lamp(map, sun, 0.6, {9000, 8000, 6000});
      return map;
    }();
    const MapLight light = prepare_map("x", dark, {});
    ASSERT_EQ(light.distant.size(), 1U);
    for (const int height : {32, 128}) {
      const EnvMap turned = map_in_frame(light, turn, Eigen::Vector3f::Ones(), 2 * height, height);
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
          mean += texel_solid_angle(y, 2 * height, height) * static_cast<double>(turned.radiance()(x, y, 0)) *
                  turned.direction(x, y).cast<double>();
        }
      }
      // A splat of a texel's size keeps the centroid; rows bend within a texel near the poles.
      EXPECT_LT(angle_between_deg(mean, target.cast<double>()), 0.25 * 180 / height)
          << target.transpose() << " at " << height;
    }
  }
}

TEST(MapInFrame, TheRestIsTheRadianceThere) {
  const EnvMap map = sky();
  const MapLight light = prepare_map("x", map, {});
  const Eigen::Matrix3f turn = some_rotation();
  for (const int height : {32, 128}) {
    const EnvMap turned = map_in_frame(light, turn, Eigen::Vector3f::Ones(), 2 * height, height);
    double worst = 0, sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < 2 * height; ++x) {
        const Eigen::Vector3f expected = map.sample(turn.transpose() * turned.direction(x, y));
        const Eigen::Map<const Eigen::Vector3f> found(turned.radiance().pixel(x, y));
        const double error = static_cast<double>((found - expected).cwiseAbs().maxCoeff() / expected.maxCoeff());
        worst = std::max(worst, error);
        sum += error * texel_solid_angle(y, 2 * height, height) / (4 * kPi);
      }
    }
    // Small targets pass through cells, which ripple by a few per cent and are a sixth too bright at the poles' four cells.
    EXPECT_LT(worst, height == 32 ? 0.25 : 0.01) << height;
    EXPECT_LT(sum, height == 32 ? 0.01 : 0.002) << height;
  }
}

TEST(MapInFrame, UnturnedAtItsOwnSizeIsTheMapButForTheLights) {
  const Eigen::Vector3f sun = Eigen::Vector3f(1, 1, 1).normalized();
  const EnvMap map = sunny(sun);
  const MapLight light = prepare_map("x", map, {});
  const EnvMap same =
      map_in_frame(light, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (angle_between_deg(map.direction(x, y).cast<double>(), sun.cast<double>()) < 4) continue;
      ASSERT_NEAR(same.radiance()(x, y, 2), map.radiance()(x, y, 2), 2e-3F)
          << x << ' ' << y;  // the integral's rescaling
    }
  }
}

}  // namespace
}  // namespace faceprobe::synth

#include "faceprobe/synth/map_light.h"
#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

MapLight shown(const EnvMap& map) {
  MapLight light;
  light.radiance = map;
  return light;
}

PinholeCamera camera(int width, int height, float focal_px) {
  PinholeCamera c;
  c.width_px = width;
  c.height_px = height;
  c.focal_px = focal_px;
  c.centre_px = {0.5F * static_cast<float>(width) + 3, 0.5F * static_cast<float>(height) - 2};
  return c;
}

Eigen::Vector3f ray(const PinholeCamera& c, float x, float y) {
  return Eigen::Vector3f((x - c.centre_px.x()) / c.focal_px, (c.centre_px.y() - y) / c.focal_px, -1).normalized();
}

TEST(Background, ShowsWhatLiesBehindEachPixel) {
  // Radiance linear in direction: what is seen is a closed form, at any turn, over poles and seam.
  const MapLight light = shown(sky());
  const PinholeCamera c = camera(40, 30, 12);  // 118 degrees wide
  for (int k = 0; k < 8; ++k) {
    const Eigen::Matrix3f camera_from_map =
        Eigen::AngleAxisf(0.8F * static_cast<float>(k), Eigen::Vector3f(1, 0.3F, -0.2F).normalized()).toRotationMatrix();
    const Eigen::Vector3f gain(1, 2, 3);
    const Image picture = draw_background(light, c, camera_from_map, gain, 0);
    ASSERT_EQ(picture.width(), 40);
    ASSERT_EQ(picture.height(), 30);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const Eigen::Vector3f d =
            camera_from_map.transpose() * ray(c, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const Eigen::Vector3f expected(0.5F + 0.3F * d.y() + 0.1F * d.x(), 0.6F + 0.4F * d.y(),
                                       0.8F + 0.6F * d.y() - 0.1F * d.z());
        const Eigen::Map<const Eigen::Vector3f> found(picture.pixel(x, y));
        // The spline smooths by a quarter of a squared texel, 1.4 degrees: 1e-4 of the harmonics of order 1.
        ASSERT_LT((found - expected.cwiseProduct(gain)).cwiseAbs().maxCoeff(), 1e-3F) << k << ' ' << x << ' ' << y;
      }
    }
  }
}

TEST(Background, ARedLampStandsWhereTheCameraLooks) {
  EnvMap map(kTestWidth, kTestWidth / 2);
  add_lamp(map, Eigen::Vector3f(0.3F, 0.2F, -1).normalized(), 3,
           {10, 0, 0});  // in front: right of the middle and above it
  const PinholeCamera c = camera(100, 100, 100);
  const Image picture = draw_background(shown(map), c, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), 0);
  double sum = 0, at_x = 0, at_y = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const double red = picture(x, y, 0);
      sum += red;
      at_x += red * (x + 0.5);
      at_y += red * (y + 0.5);
      EXPECT_EQ(picture(x, y, 1), 0);
    }
  }
  ASSERT_GT(sum, 0);
  // A texel is 2.5 pixels; perspective moves a disc's centroid outwards by a fraction of its three degrees.
  EXPECT_NEAR(at_x / sum, 53 + 30, 0.7);
  EXPECT_NEAR(at_y / sum, 48 - 20, 0.7);
}

TEST(Background, CoarseMapsShowNoBlocksAndNoDarkRings) {
  EnvMap map(64, 32);
  for (float& value : map.radiance().values()) value = 1;
  for (int c = 0; c < 3; ++c) map.radiance()(0, 16, c) = 1000;  // -z: where the camera looks, at the seam
  const PinholeCamera c = camera(128, 128, 200);                // 20 pixels a texel
  const Image picture = draw_background(shown(map), c, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), 0);
  float largest = 0, step = 0, bend = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 1; x + 1 < 128; ++x) {
      EXPECT_GE(picture(x, y, 0), 1 - 1e-3F);
      largest = std::max(largest, picture(x, y, 0));
      step = std::max(step, std::abs(picture(x, y, 0) - picture(x - 1, y, 0)));
      bend = std::max(bend, std::abs(picture(x + 1, y, 0) - 2 * picture(x, y, 0) + picture(x - 1, y, 0)));
    }
  }
  EXPECT_GT(largest, 500);
  // The spline's steepest slope is 1 and its curvature 2, times .75 across: over 19.6 pixels a texel, 38 and 3.9. A bilinear
  // look-up bends by 51 where texels meet.
  EXPECT_LT(step, 40);
  EXPECT_LT(bend, 5);
}

TEST(Background, DefocusHasTheDeviationAskedForAtEveryStrength) {
  EnvMap map(1024, 512);
  for (float& value : map.radiance().values()) value = 0;
  add_lamp(map, Eigen::Vector3f(0, 0, -1), 0.5, {1, 1, 1});
  const PinholeCamera c = camera(128, 128, 150);
  const auto variance = [&](float blur) {
    const Image picture = draw_background(shown(map), c, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), blur);
    double sum = 0, second = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const double dx = x + 0.5 - 67;
        sum += picture(x, y, 2);
        second += picture(x, y, 2) * dx * dx;
      }
    }
    return second / sum;
  };
  const double sharp = variance(0);
  for (const float blur : {0.3F, 1.0F, 1.9F, 2.1F, 3.5F, 5.0F, 9.0F}) {
    // The kernel's cut ends, few lattice points on a lamp of 2.6 pixels where the lattice is coarse; and the least blurs are small
    // beside the lamp's own variance.
    EXPECT_NEAR((variance(blur) - sharp) / (blur * blur), 1.0, blur < 1 ? 0.05 : 0.04) << blur;
  }
}

TEST(Background, WhatIsOutsideBlursIn) {
  EnvMap map(kTestWidth, kTestWidth / 2);
  const PinholeCamera c = camera(64, 64, 100);
  add_lamp(map, ray(c, -4, 30), 2, {50, 50, 50});  // four pixels off the left edge, of 3.5 pixels' radius
  EXPECT_GT(draw_background(shown(map), c, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), 4)(0, 30, 0), 1);
}

TEST(Background, NothingIsDrawnOfNoPixels) {
  EXPECT_TRUE(
      draw_background(shown(sky()), camera(0, 0, 10), Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), 1).empty());
}

}  // namespace
}  // namespace faceprobe::synth

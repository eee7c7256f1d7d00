#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

namespace faceprobe {
namespace {

TEST(Angles, FollowTheFrame) {
  EXPECT_NEAR(azimuth_deg({1, 0, 0}), 90, 1e-12);    // right of the photo
  EXPECT_NEAR(azimuth_deg({0, 0, 1}), 0, 1e-12);     // towards the viewer
  EXPECT_NEAR(elevation_deg({0, 1, 0}), 90, 1e-12);  // up
}

TEST(Angles, RoundTrip) {
  for (double azimuth = -175; azimuth <= 180; azimuth += 13) {
    for (double elevation = -85; elevation <= 85; elevation += 17) {
      const Eigen::Vector3d d = direction_from_angles(azimuth, elevation);
      EXPECT_NEAR(d.norm(), 1, 1e-14);
      EXPECT_NEAR(azimuth_deg(d), azimuth, 1e-10);
      EXPECT_NEAR(elevation_deg(d), elevation, 1e-10);
    }
  }
}

TEST(Angles, SmallAndOppositeAnglesKeepTheirDigits) {
  // acos(dot) would return 0 or 1.2e-6 degrees here: 1e-7 degrees is below the square root of the machine epsilon.
  const Eigen::Vector3d a(0, 0, 1);
  const Eigen::Vector3d b = direction_from_angles(1e-7, 0);
  EXPECT_NEAR(angle_between_deg(a, b) / 1e-7, 1, 1e-6);
  EXPECT_NEAR((180 - angle_between_deg(a, -3 * b)) / 1e-7, 1, 1e-6);
}

}  // namespace
}  // namespace faceprobe

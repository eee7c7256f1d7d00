#include "faceprobe/lighting/horizon.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/lighting/observations.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

// A flat plane 1 m away, 1 mm a pixel, with a wall `height` m high in the columns from `wall` on.
Image plane_with_wall(int size, int wall, float height) {
  Image position(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      position(x, y, 0) = 0.001F * static_cast<float>(x + 1);
      position(x, y, 1) = -0.001F * static_cast<float>(y + 1);
      position(x, y, 2) = -1.0F + (x >= wall ? height : 0.0F);
    }
  }
  return position;
}

TEST(Horizon, WallCastsItsShadowAtTheRightAngle) {
  const Image position = plane_with_wall(101, 70, 0.02F);
  Eigen::MatrixX2i pixel(1, 2);
  pixel << 50, 50;
  const Eigen::RowVectorXf horizon = horizon_tangents(position, pixel).row(0);
  // The wall begins 20 mm to the right and is 20 mm high; marching may first touch it up to 15 % later.
  EXPECT_GT(horizon[0], 0.85F);
  EXPECT_LE(horizon[0], 1.0F);
  EXPECT_NEAR(horizon[kHorizonAzimuths / 2], 0.0F, 1e-4F);  // to the left the plane itself is the horizon
  EXPECT_EQ(horizon_visibility(horizon, direction_from_angles(80, 0).cast<float>()), 0.0F);  // 10 degrees over the plane
  EXPECT_EQ(horizon_visibility(horizon, direction_from_angles(20, 0).cast<float>()), 1.0F);   // 70 degrees
  EXPECT_EQ(horizon_visibility(horizon, direction_from_angles(-80, 0).cast<float>()), 1.0F);  // other side
}

TEST(Horizon, UpInThePictureIsUpInTheWorld) {
  Image position = plane_with_wall(101, 1000, 0.0F);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 101; ++x) position(x, y, 2) += 0.03F;  // a brow above
  }
  Eigen::MatrixX2i pixel(1, 2);
  pixel << 50, 50;
  const Eigen::RowVectorXf horizon = horizon_tangents(position, pixel).row(0);
  EXPECT_LT(horizon_visibility(horizon, direction_from_angles(0, 80).cast<float>()), 0.01F);  // steep light from above
  EXPECT_EQ(horizon_visibility(horizon, direction_from_angles(0, -80).cast<float>()), 1.0F);
}

TEST(Horizon, EmptySurroundingsBlockNothing) {
  Image position(64, 64, 3);
  position(32, 32, 2) = -1.0F;
  Eigen::MatrixX2i pixel(1, 2);
  pixel << 32, 32;
  const Eigen::RowVectorXf horizon = horizon_tangents(position, pixel).row(0);
  EXPECT_EQ(horizon_visibility(horizon, Eigen::Vector3f(1, 0, -0.5F).normalized()), 1.0F);
}

}  // namespace
}  // namespace faceprobe::lighting

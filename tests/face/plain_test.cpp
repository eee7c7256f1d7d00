// What lean builds use in OpenCV's place, against OpenCV.

#include "face/fixtures.h"
#include "face/pose.h"
#include "face/pose_candidates.h"
#include "face/warp.h"
#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::face {
namespace {

const Camera kCamera{900, 400, 300};

// Smooth, so that 1/32 px, to which OpenCV rounds places, changes little.
Image waves(int width, int height, int channels) {
  Image picture(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < channels; ++k) {
        picture(x, y, k) = 0.5F + 0.4F * std::sin(0.11F * static_cast<float>(x) + static_cast<float>(k)) *
                                      std::cos(0.07F * static_cast<float>(y));
      }
    }
  }
  return picture;
}

TEST(Plain, HalvesAsOpenCvDoes) {
  for (const int channels : {1, 3}) {
    const Image picture = waves(65, 42, channels);
    const Image mine = plain::half_size(picture);
    const Image theirs = half_size(picture);
    ASSERT_TRUE(mine.same_size(theirs));
    EXPECT_EQ(mine.width(), 32);
    for (std::size_t i = 0; i < mine.values().size(); ++i)
      EXPECT_NEAR(mine.data()[i], theirs.data()[i], 1e-6);  // the order of a sum of four
  }
}

TEST(Plain, WarpsAsOpenCvDoes) {
  const Image picture = waves(80, 60, 3);
  Affine turned;
  turned << 0.9, -0.5, 25.3, 0.5, 0.9, -4.8;  // partly outside
  const Image mine = plain::warp_square(picture, turned, 64);
  const Image theirs = warp_square(picture, turned, 64);
  int outside = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Eigen::Vector2d at = turned * Eigen::Vector3d(x, y, 1);
      const bool edge = at.x() < 0 || at.y() < 0 || at.x() > picture.width() - 1 || at.y() > picture.height() - 1;
      outside += theirs(x, y, 0) == 0 ? 1 : 0;
      // 1/64 px at the steepest slope of .4 * .11 + .4 * .07 a pixel; across the black edge the slope is 1 a pixel.
      const float allowed = edge ? 0.04F : 0.0015F;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(mine(x, y, k), theirs(x, y, k), allowed) << x << ' ' << y;
    }
  }
  EXPECT_GT(outside, 100) << "nothing was outside";
}

TEST(Plain, WarpIsExactBetweenPixels) {
  Image ramp(4, 4, 1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) ramp(x, y) = static_cast<float>(x + 10 * y);
  }
  Affine shifted;
  shifted << 1, 0, 0.3, 0, 1, 1.6;
  EXPECT_NEAR(plain::warp_square(ramp, shifted, 1)(0, 0), 16.3F, 1e-5);
}

double best_rms(const std::vector<Eigen::Isometry3d>& poses, const Eigen::MatrixX3d& face, const Eigen::MatrixX2d& px) {
  double best = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& pose : poses) {
    const bool behind = ((pose * face.transpose()).row(2).array() >= 0).any();
    if (pose.matrix().allFinite() && !behind) best = std::min(best, reprojection_rms_px(face, px, kCamera, pose));
  }
  return best;
}

// The least error over all starts is a property of the data, whoever finds it.
TEST(Plain, PosesFitAsWellAsOpenCvs) {
  Random random({3});
  const std::vector<int> rigid = rigid_vertices(canonical_mesh());
  const Eigen::MatrixX3d face = canonical_mesh().vertices_m(rigid, Eigen::all).cast<double>();
  for (const double yaw : {-75, -40, 0, 20, 60}) {
    for (const double pitch : {-30, 0, 25}) {
      for (const double roll : {-90, 0, 35, 175}) {
        const Eigen::Isometry3d truth = head_pose(yaw, pitch, roll, {0.1, -0.05, -0.7});
        Eigen::MatrixX2d px = projected_landmarks(kCamera, truth)(rigid, Eigen::seq(0, 1)).cast<double>();
        for (double& value : px.reshaped()) value += random.normal();  // px
        const double mine = best_rms(plain::candidate_poses(face, px, kCamera), face, px);
        const double theirs = best_rms(candidate_poses(face, px, kCamera), face, px);
        EXPECT_LT(mine, theirs + 1e-6) << yaw << ' ' << pitch << ' ' << roll;
      }
    }
  }
}

TEST(Plain, PointsThatAreNoFaceHaveNoPose) {
  const Eigen::MatrixX3d face = Eigen::MatrixX3d::Zero(5, 3);
  const Eigen::MatrixX2d px = Eigen::MatrixX2d::Zero(5, 2);
  EXPECT_FALSE(std::isfinite(best_rms(plain::candidate_poses(face, px, kCamera), face, px)));
}

}  // namespace
}  // namespace faceprobe::face

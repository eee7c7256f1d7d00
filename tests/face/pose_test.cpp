#include "face/pose.h"

#include "face/fixtures.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"

#include <gtest/gtest.h>
#include <random>

namespace faceprobe::face {
namespace {

const Camera kCamera{900, 400, 300};

struct Case {
  double yaw, pitch, roll;
  Eigen::Vector3d position;
};
const std::array<Case, 6> kCases = {{{0, 0, 0, {0, 0, -0.6}},
                                     {35, 0, 0, {0.1, 0, -0.8}},
                                     {-60, 10, 0, {0, 0.1, -0.5}},
                                     {10, -25, 40, {-0.2, 0.1, -1.2}},
                                     {0, 20, -90, {0, 0, -0.4}},
                                     {5, 5, 175, {0.3, -0.2, -2}}}};

TEST(Pose, ExactLandmarksGiveTheExactPose) {
  for (const Case& c : kCases) {
    const Eigen::Isometry3d truth = head_pose(c.yaw, c.pitch, c.roll, c.position);
    const Eigen::Isometry3d found = fit_pose(projected_landmarks(kCamera, truth), canonical_mesh(), kCamera);
    EXPECT_LT(angle_deg(found, truth), 0.1) << c.yaw << ' ' << c.roll;
    EXPECT_LT((found.translation() - c.position).norm(), 0.005 * c.position.norm());
  }
}

TEST(Pose, NoiseOfAPixelMovesItLittle) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 1);
  for (const Case& c : kCases) {
    const Eigen::Isometry3d truth = head_pose(c.yaw, c.pitch, c.roll, c.position);
    Eigen::MatrixX3f landmarks = projected_landmarks(kCamera, truth);
    for (int i = 0; i < landmarks.rows(); ++i)
      landmarks.row(i).head<2>() += Eigen::RowVector2f(noise(random), noise(random));
    const Eigen::Isometry3d found = fit_pose(landmarks, canonical_mesh(), kCamera);
    // Face f * 0.15 m / z px wide, over 200 points: 1 px turns a lever of half the width by 1 / (w/2) rad, over
    // sqrt(200 / 2); depth differences are a third of the width, and five standard deviations leave room for their
    // poorer lever.
    const double width_px = kCamera.focal_px * 0.15 / c.position.norm();
    EXPECT_LT(angle_deg(found, truth), degrees(5 * 3 * 2 / width_px / 10)) << c.yaw;
    EXPECT_LT(std::abs(found.translation().norm() / c.position.norm() - 1), 5 * 2 / width_px / 5);
  }
}

TEST(Pose, ReprojectionErrorIsTheRootMeanSquare) {
  Eigen::MatrixX3d face(4, 3);
  face << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1;
  const Eigen::Isometry3d pose = head_pose(0, 0, 0, {0, 0, -1});
  Eigen::MatrixX2d px(4, 2);
  for (int i = 0; i < 4; ++i) px.row(i) = kCamera.project(pose * face.row(i).transpose()).transpose();
  EXPECT_NEAR(reprojection_rms_px(face, px, kCamera, pose), 0, 1e-9);
  px(0, 0) += 6;
  px(3, 1) -= 8;
  EXPECT_NEAR(reprojection_rms_px(face, px, kCamera, pose), 5, 1e-9);  // sqrt((36 + 64) / 4)
}

TEST(Pose, PointsThatAreNoFaceAreRefused) {
  EXPECT_THROW(fit_pose(Eigen::MatrixX3d::Zero(5, 3), Eigen::MatrixX2d::Zero(5, 2), kCamera), Error);
}

TEST(Pose, PosedMeshIsTheRigidMeshForARigidFace) {
  for (const Case& c : kCases) {
    const Eigen::Isometry3d truth = head_pose(c.yaw, c.pitch, c.roll, c.position);
    const Eigen::MatrixX3f landmarks = projected_landmarks(kCamera, truth);
    const Eigen::MatrixX3f found = posed_mesh(landmarks, truth, canonical_mesh(), kCamera);
    const Eigen::MatrixX3d exact = (truth * canonical_mesh().vertices_m.cast<double>().transpose()).transpose();
    // Centimetres of depth error would be a tenth of the face; the scale of z differs by z / |position| off the axis,
    // so that 4 cm of depth may be wrong by some percent.
    EXPECT_LT((found.cast<double>() - exact).rowwise().norm().maxCoeff(), 0.005) << c.yaw;
    for (int i = 0; i < found.rows(); ++i) {
      const Eigen::Vector2d px = kCamera.project(found.row(i).transpose().cast<double>());
      EXPECT_NEAR((px - landmarks.row(i).head<2>().transpose().cast<double>()).norm(), 0, 0.01);  // float vertices
    }
  }
}

TEST(Pose, RigidVerticesAreSymmetricAndEnough) {
  const std::vector<int> rigid = rigid_vertices(canonical_mesh());
  EXPECT_GT(rigid.size(), 100U);
  double balance = 0;
  for (const int i : rigid) balance += static_cast<double>(canonical_mesh().vertices_m(i, 0));
  EXPECT_NEAR(balance, 0, 1e-3);  // metres over all of them; one missing mirror image would be a centimetre or more
}

}  // namespace
}  // namespace faceprobe::face

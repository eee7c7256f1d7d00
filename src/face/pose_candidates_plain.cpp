#include "face/pose_candidates.h"
#include "faceprobe/core/angles.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace faceprobe::face {
namespace {

using Normal = Eigen::Matrix<double, 6, 6>;
using Step = Eigen::Matrix<double, 6, 1>;  // turn about the points' middle, then shift

constexpr int kIterations = 60;
constexpr double kSmallStep = 1e-10;
constexpr double kNear = 1e-6;  // metres in front of the camera: nearer points have no picture

struct System {
  Normal normal = Normal::Zero();
  Step gradient = Step::Zero();
  double error = 0;  // sum of squares, px^2
};

Eigen::Vector3d middle_of(const Eigen::Matrix3Xd& points) { return points.rowwise().mean(); }

// Gauss and Newton's equations at a pose; error = infinity where a point is behind the camera.
System equations(const Eigen::Matrix3Xd& points_cam, const Eigen::MatrixX2d& px, const Camera& camera) {
  System system;
  const Eigen::Vector3d middle = middle_of(points_cam);
  for (Eigen::Index i = 0; i < points_cam.cols(); ++i) {
    const Eigen::Vector3d p = points_cam.col(i);
    const double depth = -p.z();
    if (!(depth > kNear)) {
      system.error = std::numeric_limits<double>::infinity();
      return system;
    }
    const Eigen::Vector2d off = camera.project(p) - px.row(i).transpose();
    // x = cx + f X / depth, y = cy - f Y / depth, depth = -Z.
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1, 0, p.x() / depth, 0, -1, -p.y() / depth;
    by_point *= camera.focal_px / depth;
    const Eigen::Vector3d arm = p - middle;
    Eigen::Matrix<double, 3, 6> by_step;
    by_step << 0, arm.z(), -arm.y(), 1, 0, 0, -arm.z(), 0, arm.x(), 0, 1, 0, arm.y(), -arm.x(), 0, 0, 0, 1;
    const Eigen::Matrix<double, 2, 6> jacobian = by_point * by_step;
    system.normal += jacobian.transpose() * jacobian;
    system.gradient += jacobian.transpose() * off;
    system.error += off.squaredNorm();
  }
  return system;
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& middle, const Step& step) {
  const Eigen::Vector3d turn = step.head<3>();
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  move.translation() = middle + step.tail<3>() - move.linear() * middle;
  return move * pose;
}

// Levenberg and Marquardt's way down from a start.
Eigen::Isometry3d polished(const Eigen::MatrixX3d& face, const Eigen::MatrixX2d& px, const Camera& camera,
                           Eigen::Isometry3d pose) {
  Eigen::Matrix3Xd points = pose * face.transpose();
  System here = equations(points, px, camera);
  double damping = 1e-3;
  for (int i = 0; i < kIterations && std::isfinite(here.error); ++i) {
    Normal damped = here.normal;
    damped.diagonal() *= 1 + damping;
    const Step step = -damped.ldlt().solve(here.gradient);
    if (!step.allFinite()) break;
    const Eigen::Isometry3d next = moved(pose, middle_of(points), step);
    const Eigen::Matrix3Xd next_points = next * face.transpose();
    const System there = equations(next_points, px, camera);
    if (there.error <= here.error) {
      const bool done = step.norm() < kSmallStep;
      pose = next;
      points = next_points;
      here = there;
      damping = std::max(damping * 0.1, 1e-12);
      if (done) break;
    } else {
      damping *= 10;
      if (damping > 1e12) break;
    }
  }
  return pose;
}

}  // namespace

std::vector<Eigen::Isometry3d> plain::candidate_poses(const Eigen::MatrixX3d& points_face_m,
                                                      const Eigen::MatrixX2d& points_px, const Camera& camera) {
  // From the front and from heads turned about their own axes, so that profiles do not end in the mirrored minimum.
  static constexpr std::array<std::array<double, 2>, 5> kTurns = {{{0, 0}, {50, 0}, {-50, 0}, {0, 30}, {0, -30}}};
  const Eigen::Isometry3d frontal = frontal_guess(points_face_m, points_px, camera);
  const Eigen::Vector3d middle = points_face_m.colwise().mean().transpose();
  std::vector<Eigen::Isometry3d> poses;
  for (const auto& [yaw_deg, pitch_deg] : kTurns) {
    const Eigen::Isometry3d start =
        frontal * Eigen::Translation3d(middle) * Eigen::AngleAxisd(radians(yaw_deg), Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(radians(pitch_deg), Eigen::Vector3d::UnitX()) * Eigen::Translation3d(-middle);
    if (start.matrix().allFinite()) poses.push_back(polished(points_face_m, points_px, camera, start));
  }
  return poses;
}

}  // namespace faceprobe::face

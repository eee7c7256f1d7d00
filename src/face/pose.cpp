#include "face/pose.h"

#include "face/landmark_sets.h"
#include "face/pose_candidates.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::face {

Eigen::Isometry3d frontal_guess(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                                const Camera& camera) {
  const Eigen::RowVector3d face_mean = points_face_m.colwise().mean();
  const Eigen::RowVector2d px_mean = points_px.colwise().mean();
  double along = 0;
  double across = 0;
  double size = 0;
  for (Eigen::Index i = 0; i < points_face_m.rows(); ++i) {  // 2-D similarity, y of the face pointing up
    const Eigen::Vector2d f(points_face_m(i, 0) - face_mean.x(), face_mean.y() - points_face_m(i, 1));
    const Eigen::Vector2d p = (points_px.row(i) - px_mean).transpose();
    along += f.dot(p);
    across += f.x() * p.y() - f.y() * p.x();
    size += f.squaredNorm();
  }
  const double px_per_m = std::max(std::hypot(along, across) / size, 1e-9);
  const double roll = std::atan2(across, along);  // clockwise in the picture, whose y points down
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(-roll, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d centre((px_mean.x() - camera.centre_x_px) / px_per_m,
                               (camera.centre_y_px - px_mean.y()) / px_per_m, -camera.focal_px / px_per_m);
  pose.translation() = centre - pose.linear() * face_mean.transpose();
  return pose;
}

double reprojection_rms_px(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                           const Camera& camera, const Eigen::Isometry3d& camera_from_face) {
  double sum = 0;
  for (Eigen::Index i = 0; i < points_face_m.rows(); ++i) {
    const Eigen::Vector2d seen = camera.project(camera_from_face * points_face_m.row(i).transpose());
    sum += (seen - points_px.row(i).transpose()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points_face_m.rows()));
}

Eigen::Isometry3d fit_pose(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                           const Camera& camera) {
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  double best_rms = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& pose : candidate_poses(points_face_m, points_px, camera)) {
    if (!pose.matrix().allFinite()) continue;
    if (((pose * points_face_m.transpose()).row(2).array() >= 0).any()) continue;  // behind the camera
    const double rms = reprojection_rms_px(points_face_m, points_px, camera, pose);
    if (rms < best_rms) {
      best_rms = rms;
      best = pose;
    }
  }
  if (!std::isfinite(best_rms)) {
    throw Error(ExitCode::kNoFace,
                "The landmarks fit no face in front of the camera; check their order and the focal length.");
  }
  return best;
}

std::vector<int> rigid_vertices(const CanonicalMesh& mesh) {
  constexpr float kMouthTop = -0.022F;  // below: lips, chin and jaw move
  constexpr float kEarSide = 0.070F;    // beyond: the outline, which the network draws where it sees an edge
  std::vector<bool> moves(static_cast<std::size_t>(mesh.vertices_m.rows()), false);
  const auto mark = [&](const auto& ring) {
    for (const int right : ring) {
      moves[static_cast<std::size_t>(right)] = true;
      const Eigen::RowVector3f mirrored = mesh.vertices_m.row(right).cwiseProduct(Eigen::RowVector3f(-1, 1, 1));
      Eigen::Index left = 0;
      (mesh.vertices_m.rowwise() - mirrored).rowwise().squaredNorm().minCoeff(&left);
      moves[static_cast<std::size_t>(left)] = true;
    }
  };
  mark(kRightEyeRing);
  mark(kRightBrowRing);
  for (const int corner : {kRightEyeOuterCorner, kRightEyeInnerCorner, kLeftEyeInnerCorner, kLeftEyeOuterCorner}) {
    moves[static_cast<std::size_t>(corner)] = false;
  }
  std::vector<int> rigid;
  for (int i = 0; i < mesh.vertices_m.rows(); ++i) {
    if (!moves[static_cast<std::size_t>(i)] && mesh.vertices_m(i, 1) > kMouthTop &&
        std::abs(mesh.vertices_m(i, 0)) < kEarSide) {
      rigid.push_back(i);
    }
  }
  return rigid;
}

Eigen::Isometry3d fit_pose(const Eigen::MatrixX3f& landmarks_px, const CanonicalMesh& mesh, const Camera& camera) {
  const std::vector<int> rigid = rigid_vertices(mesh);
  const Eigen::MatrixX3d face = mesh.vertices_m(rigid, Eigen::all).cast<double>();
  const Eigen::MatrixX2d px = landmarks_px(rigid, Eigen::seq(0, 1)).cast<double>();
  return fit_pose(face, px, camera);
}

Eigen::MatrixX3f posed_mesh(const Eigen::MatrixX3f& landmarks_px, const Eigen::Isometry3d& camera_from_face,
                            const CanonicalMesh& mesh, const Camera& camera) {
  // The network sees the crop as if the camera looked straight at it: its depth runs along the ray to the face's
  // centre.
  const Eigen::Matrix3Xd rigid_cam = camera_from_face * mesh.vertices_m.cast<double>().transpose();
  const Eigen::Vector3d centre = rigid_cam.rowwise().mean();
  const Eigen::Vector3d axis = centre.normalized();
  const double distance = centre.norm();

  // Metres per network pixel of depth, at the face.
  const double m_per_px = distance * std::abs(axis.z()) / camera.focal_px;
  // Only the rigid part anchors the mean depth: an open mouth must not push the forehead.
  double offset = 0;
  const std::vector<int> rigid = rigid_vertices(mesh);
  for (const int i : rigid) offset += axis.dot(rigid_cam.col(i)) - m_per_px * static_cast<double>(landmarks_px(i, 2));
  offset /= static_cast<double>(rigid.size());

  Eigen::MatrixX3f vertices(landmarks_px.rows(), 3);
  for (Eigen::Index i = 0; i < landmarks_px.rows(); ++i) {
    const double depth = std::max(offset + m_per_px * static_cast<double>(landmarks_px(i, 2)), 0.3 * distance);
    const Eigen::Vector3d ray =
        -camera.view_direction(static_cast<double>(landmarks_px(i, 0)), static_cast<double>(landmarks_px(i, 1)));
    vertices.row(i) = (ray * (depth / std::max(axis.dot(ray), 0.1))).cast<float>().transpose();
  }
  return vertices;
}

}  // namespace faceprobe::face

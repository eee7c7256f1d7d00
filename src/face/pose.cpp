#include "face/pose.h"

#include "face/landmark_sets.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace faceprobe::face {
namespace {

// OpenCV's camera frame has y down and z forward; ours y up and z to the viewer. Its own inverse.
const Eigen::Vector3d kFlip(1, -1, -1);

Eigen::Isometry3d to_isometry(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const Eigen::Vector3d axis_angle(rotation_vector.at<double>(0), rotation_vector.at<double>(1),
                                   rotation_vector.at<double>(2));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (axis_angle.norm() > 0)
    pose.linear() = Eigen::AngleAxisd(axis_angle.norm(), axis_angle.normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  pose.linear() = kFlip.asDiagonal() * pose.linear();
  pose.translation() = kFlip.asDiagonal() * pose.translation();
  return pose;
}

// A head that looks into the camera, as large and as tilted in the picture as the points are.
void frontal_guess(const Eigen::MatrixX3d& face, const Eigen::MatrixX2d& px, const Camera& camera,
                   cv::Mat& rotation_vector, cv::Mat& translation) {
  const Eigen::RowVector3d face_mean = face.colwise().mean();
  const Eigen::RowVector2d px_mean = px.colwise().mean();
  double along = 0;
  double across = 0;
  double size = 0;
  for (Eigen::Index i = 0; i < face.rows(); ++i) {  // 2-D similarity, y of the face pointing up
    const Eigen::Vector2d f(face(i, 0) - face_mean.x(), face_mean.y() - face(i, 1));
    const Eigen::Vector2d p = (px.row(i) - px_mean).transpose();
    along += f.dot(p);
    across += f.x() * p.y() - f.y() * p.x();
    size += f.squaredNorm();
  }
  const double px_per_m = std::max(std::hypot(along, across) / size, 1e-9);
  const double roll = std::atan2(across, along);
  Eigen::Matrix3d rotation = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() * kFlip.asDiagonal();
  const double distance = camera.focal_px / px_per_m;
  const Eigen::Vector3d centre((px_mean.x() - camera.centre_x_px) / px_per_m,
                               (px_mean.y() - camera.centre_y_px) / px_per_m, distance);
  const Eigen::Vector3d shift = centre - rotation * face_mean.transpose();
  const Eigen::AngleAxisd axis_angle(rotation);
  const Eigen::Vector3d vector = axis_angle.angle() * axis_angle.axis();
  rotation_vector = (cv::Mat_<double>(3, 1) << vector.x(), vector.y(), vector.z());
  translation = (cv::Mat_<double>(3, 1) << shift.x(), shift.y(), shift.z());
}

}  // namespace

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
  std::vector<cv::Point3d> face;
  std::vector<cv::Point2d> px;
  for (Eigen::Index i = 0; i < points_face_m.rows(); ++i) {
    face.emplace_back(points_face_m(i, 0), points_face_m(i, 1), points_face_m(i, 2));
    px.emplace_back(points_px(i, 0), points_px(i, 1));
  }
  const cv::Matx33d intrinsics(camera.focal_px, 0, camera.centre_x_px, 0, camera.focal_px, camera.centre_y_px, 0, 0, 1);
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-10);

  // A closed form that is right for good data, and the frontal guess that keeps few noisy points out of its mirrored
  // solutions; both polished, the better one wins.
  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  double best_rms = std::numeric_limits<double>::infinity();
  for (const bool closed_form : {true, false}) {
    cv::Mat rotation_vector;
    cv::Mat translation;
    try {
      if (closed_form) {
        if (!cv::solvePnP(face, px, intrinsics, cv::noArray(), rotation_vector, translation, false, cv::SOLVEPNP_SQPNP))
          continue;
      } else {
        frontal_guess(points_face_m, points_px, camera, rotation_vector, translation);
      }
      cv::solvePnPRefineLM(face, px, intrinsics, cv::noArray(), rotation_vector, translation, until);
    } catch (const cv::Exception&) {
      continue;  // degenerate points; the other start may do
    }
    const Eigen::Isometry3d pose = to_isometry(rotation_vector, translation);
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

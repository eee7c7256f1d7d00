#include "face/pose_candidates.h"

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

void from_isometry(const Eigen::Isometry3d& pose, cv::Mat& rotation_vector, cv::Mat& translation) {
  const Eigen::Matrix3d rotation = kFlip.asDiagonal() * pose.linear();
  const Eigen::Vector3d shift = kFlip.asDiagonal() * pose.translation();
  const Eigen::AngleAxisd axis_angle(rotation);
  const Eigen::Vector3d vector = axis_angle.angle() * axis_angle.axis();
  rotation_vector = (cv::Mat_<double>(3, 1) << vector.x(), vector.y(), vector.z());
  translation = (cv::Mat_<double>(3, 1) << shift.x(), shift.y(), shift.z());
}

}  // namespace

std::vector<Eigen::Isometry3d> candidate_poses(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
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
  // solutions; both polished.
  std::vector<Eigen::Isometry3d> poses;
  for (const bool closed_form : {true, false}) {
    cv::Mat rotation_vector;
    cv::Mat translation;
    try {
      if (closed_form) {
        if (!cv::solvePnP(face, px, intrinsics, cv::noArray(), rotation_vector, translation, false, cv::SOLVEPNP_SQPNP))
          continue;
      } else {
        from_isometry(frontal_guess(points_face_m, points_px, camera), rotation_vector, translation);
      }
      cv::solvePnPRefineLM(face, px, intrinsics, cv::noArray(), rotation_vector, translation, until);
    } catch (const cv::Exception&) {
      continue;  // degenerate points; the other start may do
    }
    poses.push_back(to_isometry(rotation_vector, translation));
  }
  return poses;
}

}  // namespace faceprobe::face

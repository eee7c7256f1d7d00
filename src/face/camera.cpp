#include "faceprobe/face/face.h"

namespace faceprobe::face {

Eigen::Vector3d Camera::view_direction(double x_px, double y_px) const {
  return Eigen::Vector3d((centre_x_px - x_px) / focal_px, (y_px - centre_y_px) / focal_px, 1.0).normalized();
}

Eigen::Vector2d Camera::project(const Eigen::Vector3d& point_cam_m) const {
  const double px_per_m = focal_px / -point_cam_m.z();
  return {centre_x_px + point_cam_m.x() * px_per_m, centre_y_px - point_cam_m.y() * px_per_m};
}

}  // namespace faceprobe::face

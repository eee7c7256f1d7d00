#include "faceprobe/synth/fragments.h"

namespace faceprobe::synth {

Eigen::Vector2f PinholeCamera::project(const Eigen::Vector3f& point_cam) const {
  const float scale = focal_px / -point_cam.z();
  return {centre_px.x() + scale * point_cam.x(), centre_px.y() - scale * point_cam.y()};
}

Eigen::Vector3f PinholeCamera::ray_cam(const Eigen::Vector2f& pixel) const {
  return Eigen::Vector3f((pixel.x() - centre_px.x()) / focal_px, (centre_px.y() - pixel.y()) / focal_px, -1.0F)
      .normalized();
}

}  // namespace faceprobe::synth

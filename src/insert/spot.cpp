#include "faceprobe/insert/spot.h"

namespace faceprobe::insert {
namespace {

constexpr float kCameraDeg = 8;
constexpr float kHeadDeg = 12;

}  // namespace

Eigen::Vector3f up_from_horizon(const render::PinholeView& view, double horizon_y_px) {
  // The horizon's ray lies in the ground's plane.
  const Eigen::Vector3d ahead(0, view.centre_y_px - horizon_y_px, -view.focal_px);
  return Eigen::Vector3d(0, view.focal_px, ahead.y()).normalized().cast<float>();
}

Eigen::Vector3f up_from_heads(const std::vector<Eigen::Vector3f>& heads) {
  Eigen::Vector3f sum = Eigen::Vector3f::UnitY() / (kCameraDeg * kCameraDeg);
  for (const Eigen::Vector3f& head : heads) sum += head.normalized() / (kHeadDeg * kHeadDeg);
  return sum.normalized();
}

Eigen::Vector3f point_at(const render::PinholeView& view, double x_px, double y_px, float depth_m) {
  return depth_m * view.ray(x_px, y_px);
}

}  // namespace faceprobe::insert

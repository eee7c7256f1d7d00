#include "faceprobe/core/angles.h"

#include <Eigen/Geometry>
#include <cmath>

namespace faceprobe {

double azimuth_deg(const Eigen::Vector3d& direction) { return degrees(std::atan2(direction.x(), direction.z())); }

double elevation_deg(const Eigen::Vector3d& direction) {
  return degrees(std::atan2(direction.y(), std::hypot(direction.x(), direction.z())));
}

Eigen::Vector3d direction_from_angles(double azimuth_deg, double elevation_deg) {
  const double azimuth = radians(azimuth_deg);
  const double elevation = radians(elevation_deg);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // acos loses half its digits near 0 and 180 degrees; atan2 of sine and cosine does not.
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

}  // namespace faceprobe

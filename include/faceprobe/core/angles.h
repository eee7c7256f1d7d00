#pragma once
// Directions as people read them. Azimuth: positive to the right of the photo, 0 = towards the viewer (+z), in (-180, 180].
// Elevation: positive up. Both describe the direction FROM the face TO the light, in the camera frame.

#include <Eigen/Core>
#include <numbers>

namespace faceprobe {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double degrees(double radians) { return radians * 180.0 / kPi; }
inline constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

double azimuth_deg(const Eigen::Vector3d& direction);
double elevation_deg(const Eigen::Vector3d& direction);
Eigen::Vector3d direction_from_angles(double azimuth_deg, double elevation_deg);
// Angle between two vectors of any length, accurate for small and for opposite ones, in degrees.
double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace faceprobe

#pragma once
// Directions as people read them. Azimuth: positive to the right of the photo, 0 = towards the viewer (+z), in (-180, 180].
// Elevation: positive up. Both describe the direction FROM the face TO the light, in the camera frame.
//
//   azimuth_deg({1, 0, 1});            // 45: from the right, in front
//   direction_from_angles(0, 90);      // straight from above

#include <Eigen/Core>
#include <numbers>

namespace faceprobe {

inline constexpr double kPi = std::numbers::pi;  // radians: half a turn
// An angle in degrees from one in radians, and back.
inline constexpr double degrees(double radians) { return radians * 180.0 / kPi; }
inline constexpr double radians(double degrees) { return degrees * kPi / 180.0; }

// Degrees, of a direction of any length in the camera frame; 0 for the zero vector.
double azimuth_deg(const Eigen::Vector3d& direction);
double elevation_deg(const Eigen::Vector3d& direction);
// The unit vector, camera frame; any angles.
Eigen::Vector3d direction_from_angles(double azimuth_deg, double elevation_deg);
// Angle between two vectors of any length, accurate for small and for opposite ones, in degrees.
double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace faceprobe

#pragma once
// The sky in 160 bins, in which a network says where the sun stands (Hold-Geoffroy et al. 2017): 5 elevations of 18 degrees from the horizon to
// the zenith, 32 azimuths of 11.25 degrees. Angles are those of core/angles.h.
//
//   const int bin = sun_bin_of(sun_direction(sky));
//   const Eigen::Vector3d near = sun_bin_direction(bin);
//
// Bins near the zenith cover less of the sky than those at the horizon; for sums over directions use core/sphere_grid.h.

#include "faceprobe/core/angles.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace faceprobe {

inline constexpr int kSunElevations = 5;
inline constexpr int kSunAzimuths = 32;
inline constexpr int kSunBins = kSunElevations * kSunAzimuths;
inline constexpr double kSunElevationStepDeg = 90.0 / kSunElevations;  // 18 degrees
inline constexpr double kSunAzimuthStepDeg = 360.0 / kSunAzimuths;     // 11.25 degrees

// Bins are numbered from the lowest elevation, in each from azimuth -180 to the right. A direction below the horizon is of the lowest bins.
inline int sun_bin_of(const Eigen::Vector3d& direction) {
  const int row = static_cast<int>(std::floor(elevation_deg(direction) / kSunElevationStepDeg));
  const int column = static_cast<int>(std::floor((azimuth_deg(direction) + 180) / kSunAzimuthStepDeg));
  return std::clamp(row, 0, kSunElevations - 1) * kSunAzimuths + column % kSunAzimuths;
}

// Unit vector through the middle of a bin, 0 .. kSunBins - 1.
inline Eigen::Vector3d sun_bin_direction(int bin) {
  return direction_from_angles((bin % kSunAzimuths + 0.5) * kSunAzimuthStepDeg - 180,
                               (bin / kSunAzimuths + 0.5) * kSunElevationStepDeg);
}

}  // namespace faceprobe

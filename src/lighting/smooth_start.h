#pragma once
// A first, smooth light from the shading alone: one distant lamp and an even surround by robust least squares,
//
//   shading_i = ambient + max(0, N_i . l).
//
// Richardson-Lucy from a flat start needs thousands of steps to move low-frequency light around, because cosine rows hardly tell
// neighbouring cells apart; from here it only has to add the detail.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

struct SmoothFit {
  Eigen::Vector3f lamp = Eigen::Vector3f::Zero();  // direction times irradiance / pi
  float ambient = 0;                               // radiance of the surround
  // #patches, 0..1: Cauchy weights of the residuals. Hair, beard and cast shadows, which no smooth light explains, count little.
  Eigen::VectorXf trust;
};

// `shading`: #patches luminances. Clipped patches (true) are left out of the fit.
SmoothFit fit_smooth_light(const Observations& observations, const Eigen::VectorXf& shading,
                           const Eigen::Array<bool, Eigen::Dynamic, 1>& clipped);

// #cells: the surround plus a broad lobe with the lamp's energy; positive everywhere.
Eigen::VectorXf smooth_radiance(const SmoothFit& fit, const SphereGrid& grid, float level);

}  // namespace faceprobe::lighting

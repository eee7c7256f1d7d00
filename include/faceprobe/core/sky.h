#pragma once
// A clear sky, its sun and the ground below it, from a few numbers: the analytic daylight of Preetham, Shirley & Smits 1999 ("A practical
// analytic model for daylight", SIGGRAPH). Sky luminance and chromaticity are Perez's five-term function with that paper's coefficients
// (appendix A.2), the sun's colour and strength its transmittances at one wavelength a channel (appendix A.1, without water and gases). World
// up is +y, azimuth and elevation as in core/angles.h.
//
//   const SkyParameters noon{.sun_azimuth_deg = 30, .sun_elevation_deg = 60, .turbidity = 3};
//   const SphereGrid grid(16);
//   const Eigen::MatrixX3f light = sky_radiance(noon, grid);
//   const Eigen::MatrixX3f seen = sky_radiance(noon, grid, level_from_camera);   // the same sky in a camera that looks up or down
//
// Not for dusk, night or clouds: the model's sun stands above the horizon and its sky is clear; `sun` alone can make a day dull. Hosek & Wilkie
// 2012 fits measured skies better, at low suns and in haze most of all; its tables are too large for here.

#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <string>

namespace faceprobe {

struct SkyParameters {
  static constexpr double kLeastTurbidity = 2;  // very clear air; below it the coefficients give no sky
  static constexpr double kMostTurbidity = 10;  // haze
  static constexpr double kMostSun = 1000;      // of `sun`, without unit

  double sun_azimuth_deg = 0;     // any angle; positive to the right, 0 = +z
  double sun_elevation_deg = 45;  // 0..90
  double turbidity = 3;           // scattering by air and haze over that by air alone
  double exposure = 1;            // radiance that stands for 1000 cd/m2, > 0
  double sun = 1;  // direct sunlight over what a clear sky of this turbidity lets through: 0 = hidden, to kMostSun
  double ground_albedo = 0.2;  // 0..1, grey, matt

  std::string validate() const;  // empty when usable, else which value is wrong
};

// Unit vector towards the sun.
Eigen::Vector3d sun_direction(const SkyParameters& sky);
// Sunlight on a surface that faces the sun, linear Rec.709, in radiance x steradian. Not for parameters that do not validate.
Eigen::Vector3d sun_irradiance(const SkyParameters& sky);

// #cells x 3, linear Rec.709. Above the horizon > 0; below it what the ground sends back of sun and sky. The sun is narrower than a cell, so its
// light is shared among the four cells around it and keeps centre and strength. `level_from_grid`: rotation from the grid's frame to the one in
// which +y is up. Throws std::invalid_argument for parameters that do not validate.
Eigen::MatrixX3f sky_radiance(const SkyParameters& sky, const SphereGrid& grid,
                              const Eigen::Matrix3f& level_from_grid = Eigen::Matrix3f::Identity());

}  // namespace faceprobe

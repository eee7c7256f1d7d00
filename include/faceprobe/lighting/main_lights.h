#pragma once
// The few lights that a person would name: local maxima of the estimated map by non-maximum suppression, each with its direction,
// colour, size and share of the energy.
//
//   for (const MainLight& lamp : main_lights(light.radiance, SphereGrid(16))) use(lamp.direction, lamp.colour);

#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::lighting {

struct MainLight {
  Eigen::Vector3d direction;  // unit, camera frame, from the face to the light: centroid of the peak
  Eigen::Vector3d colour;     // linear Rec.709, luminance 1
  double irradiance = 0;      // luminance x steradian above the surroundings, on a surface that faces the light
  double peak_radiance = 0;   // luminance of the brightest cell
  double solid_angle_sr = 0;  // irradiance / peak above the surroundings: the size of a uniform disc with the same peak
  double share = 0;           // of the whole map's energy (luminance x steradian), 0..1
  // One standard deviation each, by rate_main_lights.h; unset before.
  std::optional<double> direction_uncertainty_deg;  // root mean square angle to the true direction
  std::optional<double> irradiance_uncertainty;     // relative, of the irradiance
};

struct MainLightOptions {
  int max_lights = 5;
  double separation_deg = 25;  // two peaks closer than this are one light
  double blur_deg = 4;         // the map is smoothed by a Gaussian of this width first, so that single cells do not win
  double min_share = 0.02;     // of the energy; weaker peaks are texture
  double min_contrast = 1.5;   // peak over the median radiance of the map
  double min_confidence = 0.3;  // of the peak's cell, where confidences are given

  std::string validate() const;
};

// Lights by falling irradiance; empty for an even sky. `radiance`: #cells x 3. `confidence`: #cells, or empty for all certain.
// Throws std::invalid_argument for other sizes and options that do not validate.
std::vector<MainLight> main_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid,
                                   const MainLightOptions& options = {}, const Eigen::VectorXf& confidence = {});

// Energy of these lights of one map over the energy of all the rest of it: what photographers weigh lamps against fill by. Energy is luminance times
// steradian, of the lamps above their surroundings, as MainLight::irradiance is. 0 without lights; infinite where there is nothing else.
double light_to_ambient_ratio(const std::vector<MainLight>& lights);

// Whether no cell is brighter than another by more than rounding makes it, a ten-thousandth: such light comes from nowhere.
bool is_even(const Eigen::VectorXd& luminance);

// The same light without its first `count` main lights (fewer if there are fewer): what is above the surroundings is taken off their cells, which
// keep their colours. A lamp of a light's irradiance and this map together give the whole light, so that a renderer can have the lamp sharp.
// Throws as main_lights().
Eigen::MatrixX3f without_main_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, int count,
                                     const MainLightOptions& options = {}, const Eigen::VectorXf& confidence = {});

}  // namespace faceprobe::lighting

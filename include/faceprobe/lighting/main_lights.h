#pragma once
// The few lights that a person would name: local maxima of the estimated map by non-maximum suppression, each with its direction,
// colour, size and share of the energy.
//
//   for (const MainLight& lamp : main_lights(light.radiance, SphereGrid(16))) use(lamp.direction, lamp.colour);

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/estimate.h"

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
  // One standard deviation each, by rate_main_lights(); unset before.
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

// How far off the lights may be, by what the observations can tell (Cramer & Rao's bound of least squares, with priors). Each light is a disc of its
// solid angle; E is its irradiance, u and v turn its direction, A is the level of an even surround, and y_k(E, u, v, .., A) is what patch k mirrors
// or scatters of all lights and the surround, in luminance, seen through its own normal, view, reflectance and horizon. Then
//
//   I = P + n sum_k w_k J_k^T J_k / (W s_k^2),   J_k = dy_k / d(log E_1, u_1, v_1, log E_2, ..., log A),   C = I^-1
//   direction_uncertainty = sqrt(C_uu + C_vv + cell / 6),   irradiance_uncertainty = sqrt(C_log E)
//
// w_k: the patch's weight, W their sum, 0 where clipped. s_k: the light's residual of rows of that kind (Light::highlight_residual, shading_residual),
// times the root mean square of what was observed. n: how many patches err independently, (sum w)^2 / sum w^2 but 20 at most: errors of normals,
// layers and shadows go with whole parts of a face (ESTIMATE: with it a light as of a usual portrait is 12 degrees uncertain, and about as much
// is measured: docs/results.md). A light's columns of J are multiplied by the root of its direction's confidence: the rest was expected, not
// seen. P: priors of one standard deviation, 1 for logarithms and 1 radian for u and v, so that what nothing observed is nearly 60 degrees off a
// way. cell: solid angle of a cell of the solver's grid, steradian. So narrow lights, strong over their surround and well observed, have small
// ones. Not in it: lights that are none, two that were taken for one, and a scale that all irradiances share (albedo, exposure).
//
// Sets both of every light. `light`: what `lights` were found in, solved from `observations` by `options`. Leaves them unset where the light has no
// residuals. Throws std::invalid_argument for observations that do not validate.
void rate_main_lights(const Observations& observations, const Light& light, const SolveOptions& options,
                      std::vector<MainLight>& lights);

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

#pragma once
// How far off main lights may be, by what the observations can tell of them: what a report states beside each.
//
//   std::vector<MainLight> lights = main_lights(light.radiance, grid);
//   rate_main_lights(observations, light, options, lights);
//   use(lights.front().direction_uncertainty_deg);
//
// Not for lights of another light or of other observations: nothing says that these are theirs.

#include "faceprobe/lighting/estimate.h"
#include "faceprobe/lighting/main_lights.h"

#include <vector>

namespace faceprobe::lighting {

// By Cramer and Rao's bound of least squares, with priors. Each light is a disc of its solid angle; E is its irradiance, u and v turn
// its direction, A is the level of an even surround, and y_k(E, u, v, .., A) is what patch k mirrors or scatters of all lights and the surround, in luminance, seen through its own normal, view, reflectance and horizon. Then
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

}  // namespace faceprobe::lighting

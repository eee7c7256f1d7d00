#pragma once
// How far an estimated light is from the true one. Lights are radiances per cell of one SphereGrid, in one frame, each on a scale of its
// own: a photo does not tell how bright the light was in absolute numbers, so every metric here ignores the scale or divides it out.
//
//   const RelightError error = relight_error(bunny, truth, estimate);
//   const SphereError mirror = sphere_error(truth, estimate, grid, render::SphereMaterial::kMirror);

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/eval/lit_object.h"
#include "faceprobe/render/sphere.h"

#include <Eigen/Core>

namespace faceprobe::eval {

// Paper Sec. 5.3: the object under both lights, each pair of pictures divided by the maximum of its own diffuse one, clipped at 1; root mean
// square over the object's pixels and channels, times 255. NaN when one of the lights is black.
struct RelightError {
  double diffuse = 0;  // 0..255, both
  double glossy = 0;   // under the coat of eval/lit_object.h
};
// `truth`, `estimate`: cells of the object's grid x 3. Throws std::invalid_argument for another number.
RelightError relight_error(const LitObject& object, const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate);

// The three-sphere protocol of StyleLight and DiffusionLight, one sphere at a time, on our own spheres (render/sphere.h) and linear light
// divided by the true diffuse sphere's mean.
struct SphereError {
  double si_rmse = 0;      // after the best scale (image_metrics.h: mean of the channels, not their sum)
  double angular_deg = 0;  // between colours, mean over pixels
  double nrmse = 0;        // both pictures brought to [0, 1] between their percentiles .1 and 99.9
};
// `truth`, `estimate`: #cells of `grid` x 3. Throws std::invalid_argument for another number.
SphereError sphere_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate, const SphereGrid& grid,
                         render::SphereMaterial material);

// The supplement's error of maps: root mean square over cells of luminance once both have the same mean, over the range of the estimate
// (as the paper has it; one bright cell lowers it) or of the truth. NaN over the range of a light that is even.
struct MapError {
  double over_estimate_range = 0;  // shares of the range, 0 or more
  double over_truth_range = 0;     // the same
};
// Of #cells x 3 each, of one grid.
MapError map_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate);

// A light that one lamp dominates: the strongest of its main lights has a quarter of the energy and twice the next one's irradiance.
bool has_dominant_light(const Eigen::MatrixX3f& truth, const SphereGrid& grid);
// Angle between the strongest main lights, degrees; where the estimate has no main light, of its brightest cell. NaN when the truth has none.
double main_light_error_deg(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate, const SphereGrid& grid);
// Angle between the mean colours of two lights (radiance summed over the sphere), degrees.
double light_colour_error_deg(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate);

}  // namespace faceprobe::eval

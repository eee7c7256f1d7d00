#pragma once
// Where the sun of a map stands, as the paper's supplement measures outdoor estimates: the centroid of the map's bright area, and how many
// photos have it within so many degrees. Of several lamps the centroid lies between; where lamps count one by one use
// lighting/main_lights.h.
//
//   const std::optional<Sun> right = sun_of(truth_map), found = sun_of(estimated_map);
//   if (right) errors.push_back(sun_error(*right, found).angle_deg);
//   std::cout << sun_curve(errors).mark_deg;              // three of four photos are nearer than this
//
// Azimuth and elevation are the camera's (core/angles.h): with a camera held level they are those of the sky.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/eval/statistics.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace faceprobe::eval {

struct Sun {
  Eigen::Vector3d direction;  // unit, camera frame, from the face to the light
  double solid_angle_sr = 0;  // of the bright area
  double concentration = 0;  // length of the mean of the area's directions: 1 for one texel, 0 for light from all around
};

struct SunOptions {
  // The bright area is what outshines all but this share of the sphere, by solid angle and luminance. Texels that are as bright as the
  // border are outside, so that a lone lamp on an even surround is the whole area, unless nothing is brighter than they.
  double share = 0.01;
  // A map whose brightest texel is not this many times its mean has no sun.
  double least_contrast = 1.2;

  std::string validate() const;  // empty when usable, else which value is wrong
};

// The centroid: directions of the bright area weighted by solid angle times luminance. Nothing for a map that is even, black, or whose bright
// area lies on opposite sides. Throws std::invalid_argument for options that do not validate and for values that are no numbers.
std::optional<Sun> sun_of(const EnvMap& map, const SunOptions& options = {});
// `radiance`: #cells of `grid` x 3. Throws std::invalid_argument also for another number.
std::optional<Sun> sun_of(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const SunOptions& options = {});

// Degrees, 0 or more; NaN where nothing was found.
struct SunError {
  double angle_deg = 0;  // between the directions, to 180
  // The shorter way round, to 180; NaN too where the true sun is within 5 degrees of straight up or down.
  double azimuth_deg = 0;
  double elevation_deg = 0;  // to 180
};
// How far the estimate's sun is from the true one.
SunError sun_error(const Sun& truth, const std::optional<Sun>& estimate);

// The cumulative curve of angular errors, at a few angles.
struct SunCurve {
  static constexpr std::array<int, 7> kAnglesDeg = {5, 10, 15, 20, 30, 45, 90};
  static constexpr double kMark = 0.75;  // share of the photos, 0..1, whose errors the mark bounds

  std::size_t count = 0;    // all errors
  std::size_t missing = 0;  // those that are no number: they count as 180 degrees, which flatters nobody
  std::array<double, kAnglesDeg.size()> within{};  // share of all errors that are not above the angle, 0..1
  double mark_deg = 0;                             // three quarters of the errors are below it
  double mark_low_deg = 0;  // its 95 % interval, percentile bootstrap; NaN for fewer than two errors
  double mark_high_deg = 0;
};
// NaN everywhere for no errors. Their order does not matter. Throws std::invalid_argument when bootstrap.resamples < 1.
// `persons`: whom each error is of, for an interval that draws people (statistics.h); empty = nobody has two.
SunCurve sun_curve(std::span<const double> errors_deg, const Bootstrap& bootstrap = {},
                   std::span<const std::string> persons = {});

// A Markdown table, one line a method: the curve of metric "sun_centroid", and the medians of "sun_azimuth" and "sun_elevation". Rows
// without the metric (their light has no sun) are left out, those where it is NaN are missing. `group`, `label`: of these rows alone; an
// empty group stands for all. Empty when there are no rows.
std::string sun_markdown(const ScoreTable& table, const std::string& group = {}, const std::string& label = {});

}  // namespace faceprobe::eval

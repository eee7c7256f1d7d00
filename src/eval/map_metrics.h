#pragma once
// Internal: all that light_metrics.h says of an estimate, under the names that tables have.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/eval/lit_object.h"

#include <Eigen/Core>
#include <map>
#include <string>

namespace faceprobe::eval {

// Whether `found` is a light on the grid at all: of its number of cells, finite, not black.
bool says_light(const Eigen::MatrixX3f& found, const SphereGrid& grid);

// `found` without cells, or black: all NaN. "main_light" is there alone when `one_lamp`.
std::map<std::string, double> map_metrics(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& found,
                                          const LitObject& object, const SphereGrid& grid, bool one_lamp);

}  // namespace faceprobe::eval

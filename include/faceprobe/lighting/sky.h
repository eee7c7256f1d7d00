#pragma once
// The clear sky (core/sky.h) that an outdoor environment map is most like: how the panoramas that Hold-Geoffroy et al. 2017 ("Deep outdoor
// illumination estimation", CVPR, arXiv 1611.06403) learn from get their numbers. Theirs is the sky of Hosek & Wilkie, this one that of Preetham
// et al., which is a poorer fit to low suns and haze; the share of the sun that comes through and the ground are ours.
//
//   const SphereGrid grid(16);
//   const SkyFit fit = fit_sky(grid_from_env_map(map, grid), grid);
//   const Eigen::MatrixX3f smooth = sky_radiance(fit.sky, grid);
//
// Not for maps of rooms or of the night: they get a sky too, and only `misfit` tells.

#include "faceprobe/core/sky.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

struct SkyFit {
  SkyParameters sky;
  // Root mean square of what is left over where the map is above the horizon and away from the sun, of gamma-compressed light over its mean; cells
  // far off, such as houses, count less. 0 for a sky of the model.
  double misfit = 0;
};

// The sun is the brightest place above the horizon; turbidity and exposure are those whose sky is nearest in gamma-compressed light, houses and trees
// before it counting little; the sun's share and the ground are what the rest needs. `radiance`: #cells of `grid` x 3, world up = +y. Throws
// std::invalid_argument: another number of cells, numbers that are negative or none, nothing but black above the horizon.
SkyFit fit_sky(const Eigen::MatrixX3f& radiance, const SphereGrid& grid);

}  // namespace faceprobe::lighting

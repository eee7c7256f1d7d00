#pragma once
// Relighting error as the paper measures it: the same ball under the true and the estimated light, each pair of pictures scaled by
// the maximum of its own diffuse rendering, clipped at 1, root mean square over the disc, times 255.

#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>

namespace faceprobe::bench {

struct RelightingError {
  double diffuse = 0;
  double mirror = 0;
};

RelightingError relighting_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate,
                                 const SphereGrid& grid, int size_px = 64);

}  // namespace faceprobe::bench

#pragma once
// The smooth part of the light by least squares: spherical harmonics whose irradiance is the shading (Ramamoorthi & Hanrahan 2001; the light
// model of Knorr & Kurz 2014, here with the cosine's transfer in place of one learnt for each point of a face). What AR kits give. Not for
// small lamps: order 2 spreads them over half the sphere, and rings.
//
//   const Eigen::MatrixX3d sh = lighting::fit_harmonics(observations, 2);
//   const Eigen::MatrixX3f light = lighting::radiance_of_harmonics(sh, grid);

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

// (order + 1)^2 x 3 radiance coefficients (core/sh.h) from the shading of patches that are not clipped, order 0 to 4. `ridge`: weight of the
// coefficients' energy against the rows', which keeps what a face hardly shows near 0. Zero without usable patches. Throws
// std::invalid_argument for another order, a ridge that is not above 0, and observations that do not validate.
Eigen::MatrixX3d fit_harmonics(const Observations& observations, int order, double ridge = 1e-3);

// Radiance of the grid's cells, #cells x 3; below 0 it is cut off. Throws std::invalid_argument unless the rows are (order + 1)^2.
Eigen::MatrixX3f radiance_of_harmonics(const Eigen::MatrixX3d& coefficients, const SphereGrid& grid);

}  // namespace faceprobe::lighting

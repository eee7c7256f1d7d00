#pragma once
// A stand-in for a face with everything known: as many patches as one likes of an ellipsoid of a face's shape, under a lamp in an even surround,
// with noise.

#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>

namespace faceprobe::bench {

// From the face to the lamp, unit; camera frame.
Eigen::Vector3f solve_lamp();

// `patches` of equal area in the picture, each with its own horizon, roughness of average skin; highlights and shading by the transport model on
// 12288 cells whatever a solver takes, 3 % of noise. The same number gives the same observations.
lighting::Observations solve_observations(int patches);

}  // namespace faceprobe::bench

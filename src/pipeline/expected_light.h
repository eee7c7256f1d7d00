#pragma once
// The light that the prior expects of a face, on the solver's grid.

#include "faceprobe/lighting/observations.h"
#include "faceprobe/net/light_prior.h"
#include "faceprobe/pipeline/estimate.h"

#include <optional>

namespace faceprobe::pipeline {

// Nothing where the options do without. Throws Error(kModel): weights that cannot be read.
std::optional<net::LightPrior> load_prior(const EstimateOptions& options);

// Mean (of logarithms) of what it expects of the face and of its mirror image; in units of the shading's level. Empty when the level is 0.
Eigen::MatrixX3f expected_light(const net::LightPrior& prior, const lighting::Observations& observations, int nside);

}  // namespace faceprobe::pipeline

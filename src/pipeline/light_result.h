#pragma once
// A solved light in its other forms.

#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

LightResult light_result(lighting::Light light, const EstimateOptions& options);
// The same, and by the observations that it was solved from, how uncertain its main lights are: of the transport solver's.
LightResult solved_light(lighting::Light light, const lighting::Observations& observations,
                         const EstimateOptions& options);

// What several faces say together: each scaled to the mean energy of their own lights, thinned to the patches of one.
lighting::Observations joint_observations(const std::vector<FaceEvidence>& faces);

}  // namespace faceprobe::pipeline

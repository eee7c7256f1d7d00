#pragma once
// A solved light in its other forms.

#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

LightResult light_result(lighting::Light light, const EstimateOptions& options);

// What several faces say together: each scaled to the mean energy of their own lights, thinned to the patches of one.
lighting::Observations joint_observations(const std::vector<FaceEvidence>& faces);

}  // namespace faceprobe::pipeline

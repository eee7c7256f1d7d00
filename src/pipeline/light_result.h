#pragma once
// A solved light in its other forms.

#include "faceprobe/net/light_prior.h"
#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

LightResult light_result(lighting::Light light, const EstimateOptions& options);

// As Estimator::joint has it. `prior`: or none.
lighting::Light joint_light(const std::vector<FaceEvidence>& faces, const EstimateOptions& options,
                            const net::LightPrior* prior);

}  // namespace faceprobe::pipeline

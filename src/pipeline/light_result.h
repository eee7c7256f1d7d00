#pragma once
// A solved light in its other forms.

#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

LightResult light_result(lighting::Light light, const EstimateOptions& options);

// One light for several faces under the assumption that it is distant. A photo tells neither the faces' albedos nor the light that
// each of them gets apart, so every face is first scaled to the mean energy of the single estimates. Many faces are thinned to options.max_patches in all.
lighting::Light joint_light(const std::vector<FaceEstimate>& faces, const EstimateOptions& options);

}  // namespace faceprobe::pipeline

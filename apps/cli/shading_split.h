#pragma once
// The paper's Albedo-Shading network for the verbs that estimate. In builds with FACEPROBE_TRAIN.

#include "faceprobe/pipeline/estimate.h"

#include <string>

namespace faceprobe::cli {

// For EstimateOptions::shading_split. Throws Error(kModel) for a file that is not there, damaged, or of a network that does not take a diffuse layer,
// and as torch_side() does.
pipeline::ShadingSplit split_by_weights(const std::string& path, int threads);

}  // namespace faceprobe::cli

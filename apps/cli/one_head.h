#pragma once
// One head model by its path, for the verbs that fit one to a photo.

#include "faceprobe/face/geometry.h"
#include "faceprobe/synth/head_model.h"

#include <string>

namespace faceprobe::cli {

// A file, or an ICT-FaceKit folder. Throws Error(kUsage) when the path holds several; as assets::load_heads does.
synth::HeadModel load_one_head(const std::string& path);
// For EstimateOptions::surface_fit.
face::SurfaceFit surface_of_head(const std::string& path, int threads);

}  // namespace faceprobe::cli

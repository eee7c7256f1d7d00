#pragma once
// What to tell of a photo's faces: why there is no estimate, or what one should be read with (Estimate::warnings).

#include "faceprobe/core/error.h"
#include "faceprobe/pipeline/estimate.h"

#include <optional>
#include <string>

namespace faceprobe::pipeline {

// The sentence for a photo without a face.
Error no_face(const io::Photo& photo, const EstimateOptions& options);

// Of a face that shows no highlights (lighting::shows_highlights); else nothing. `solver`: which read it.
std::optional<std::string> no_highlights_warning(const FaceEstimate& face, lighting::Solver solver);

}  // namespace faceprobe::pipeline

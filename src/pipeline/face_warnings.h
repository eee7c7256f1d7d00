#pragma once
// What a face's estimate should be read with: sentences for Estimate::warnings.

#include "faceprobe/pipeline/estimate.h"

#include <optional>
#include <string>

namespace faceprobe::pipeline {

// Of a face that shows no highlights (lighting::shows_highlights); else nothing. `solver`: which read it.
std::optional<std::string> no_highlights_warning(const FaceEstimate& face, lighting::Solver solver);

}  // namespace faceprobe::pipeline

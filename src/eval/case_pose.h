#pragma once
// Internal: pose.txt of a case folder. Numbers in any locale, `#` begins a comment, empty lines count for nothing.

#include "faceprobe/eval/case_folder.h"

#include <string>
#include <string_view>

namespace faceprobe::eval {

std::string pose_text(const CasePose& pose);
// `file`: what sentences call it. Throws Error(kInput).
CasePose pose_from_text(std::string_view text, const std::string& file);
// Empty, or a sentence that begins with `file`: a focal length not above 0, a matrix that is no rotation, a head behind the camera.
std::string pose_problem(const CasePose& pose, const std::string& file);

}  // namespace faceprobe::eval

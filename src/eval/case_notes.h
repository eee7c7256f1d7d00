#pragma once
// Internal: case.json of a case folder: {"groups": {"scene": "indoor"}, "licence": "CC0-1.0"}. What else it says is not read.

#include "faceprobe/eval/case_folder.h"

#include <map>
#include <string>

namespace faceprobe::eval {

// Empty when there is nothing to say.
std::string notes_text(const Case& one);
// Sets `groups` and `licence`. `file`: what sentences call it. Throws Error(kInput).
void read_notes(const std::string& text, const std::string& file, Case& one);
// Empty, or a sentence that begins with `file`.
std::string groups_problem(const std::map<std::string, std::string>& groups, const std::string& file);

}  // namespace faceprobe::eval

#pragma once
// The object that a user names: one of render's shapes, or a file.

#include "faceprobe/render/model.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

// `material`: a preset for all of it in place of its own; empty = its own. Warnings of the file are logged. Throws Error(kUsage) for names that
// are none, Error(kInput) for a file that cannot be used.
render::Model object_named(const std::string& object, const std::string& material);

// "a, b, c"
std::string listed(const std::vector<std::string>& names);

}  // namespace faceprobe::cli

#pragma once
// Files of a folder as one ZIP, so that everything can be had by one click.

#include "serve/records.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::serve {

// The archive's bytes; its files are in a folder `top`. Throws Error(kOutput).
std::string zip_of(const std::filesystem::path& folder, const std::vector<ServedFile>& files, const std::string& top);

}  // namespace faceprobe::serve

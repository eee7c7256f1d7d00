#pragma once
// All environment maps of a folder.
//
//   for (const auto& [name, map] : assets::load_maps("maps/")) ...

#include "faceprobe/core/env_map.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::assets {

// The folder's .hdr and .exr files in the order of their names; the name is the file's without extension. Throws Error(kInput) when
// there are none, one cannot be read, or one holds NaN or infinity (the sentence names the texel).
std::vector<std::pair<std::string, EnvMap>> load_maps(const std::filesystem::path& folder);

}  // namespace faceprobe::assets

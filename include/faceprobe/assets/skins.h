#pragma once
// All skin textures of a folder.
//
//   for (const auto& [name, texture] : assets::load_skins("skins/")) ...

#include "faceprobe/core/image.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::assets {

// The folder's .jpg and .png files in the order of their names, sRGB, three channels. Files whose name says that they are no albedo
// (coverage, gloss, bump, normal, mask) are left out. Throws Error(kInput) when none is left, or one cannot be read.
std::vector<std::pair<std::string, ByteImage>> load_skins(const std::filesystem::path& folder);

}  // namespace faceprobe::assets

#pragma once
// Internal: pictures of case folders, and what can be wrong with them. Unlike io::read_linear_picture, which is for photos, nothing is set
// to 0: a truth that holds NaN is a mistake, and normals have signs.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/io/limits.h"

#include <filesystem>
#include <string>

namespace faceprobe::eval {

// Of an .exr or .hdr, three channels; of one channel three are made. `name`: what error sentences call it. Throws Error(kInput).
Image read_numbers(const std::filesystem::path& path, const std::string& name, const io::Limits& limits);
// The same, twice as wide as high.
EnvMap read_case_map(const std::filesystem::path& path, const std::string& name, const io::Limits& limits);

// The file of that stem, `stem`.hdr or `stem`.exr; empty when there is none. `folder_name`: for the sentence. Throws Error(kInput) for both.
std::filesystem::path map_file(const std::filesystem::path& folder, const std::string& stem,
                               const std::string& folder_name);

// Each empty, or a sentence that begins with `file`.
std::string not_finite(const std::string& file, const Image& image);
std::string negative(const std::string& file, const Image& image);
std::string black(const std::string& file, const Image& image);
std::string other_size(const std::string& file, int width, int height, int photo_width, int photo_height);

}  // namespace faceprobe::eval

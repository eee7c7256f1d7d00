#pragma once
// Photos and linear pictures from bytes in memory, for load_photo, read_linear_picture and the fuzzers.

#include "faceprobe/io/photo.h"

#include <cstddef>
#include <span>
#include <string>

namespace faceprobe::io {

// `name` is what error sentences call the file.
Photo photo_from_bytes(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);
Image linear_picture_from_bytes(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

// Sets values that are not finite, or negative, to 0 and counts both kinds.
struct CleanCount {
  std::size_t not_finite = 0;
  std::size_t negative = 0;
};
void clean_light(float* values, std::size_t count, CleanCount& counts);

inline constexpr char kFileBytesAdvice[] = ". Make it smaller, or raise the limit with --max-bytes";

}  // namespace faceprobe::io

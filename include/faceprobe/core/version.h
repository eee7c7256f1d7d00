#pragma once
// The version of this library; CMake reads it from here. Major, minor, patch; CHANGELOG.md says what they promise.
//
//   std::cout << "faceprobe " << kVersion << '\n';

#include <string_view>

namespace faceprobe {

inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace faceprobe

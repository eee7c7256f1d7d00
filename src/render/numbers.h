#pragma once
// Numbers that the path tracer uses everywhere.

#include "faceprobe/core/angles.h"

#include <limits>

namespace faceprobe::render {

inline constexpr auto kPi32 = static_cast<float>(kPi);
inline constexpr float kFar = std::numeric_limits<float>::infinity();

}  // namespace faceprobe::render

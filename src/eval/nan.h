#pragma once
// Internal: what a metric is where it has no meaning.

#include <limits>

namespace faceprobe::eval {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace faceprobe::eval

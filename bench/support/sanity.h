#pragma once
// Whether an estimate is made of usable numbers.

#include "faceprobe/pipeline/estimate.h"

#include <string>
#include <vector>

namespace faceprobe::bench {

// One entry per part that holds a NaN, an infinity or a value that cannot be (negative light, confidence outside 0..1, a main
// light whose direction is no unit vector), such as "face 1: shading"; empty for a sound estimate.
std::vector<std::string> broken_parts(const pipeline::Estimate& estimate);

}  // namespace faceprobe::bench

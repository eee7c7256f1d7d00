#pragma once
// A random float, for shapes.

#include "faceprobe/core/random.h"

namespace faceprobe::synth {

inline float draw(Random& random, double low, double high) { return static_cast<float>(random.between(low, high)); }

}  // namespace faceprobe::synth

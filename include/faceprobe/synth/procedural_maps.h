#pragma once
// A few environment maps that need no file, for tests and a first try: skies with a sun, rooms with windows and lamps. Not for training:
// six plain maps teach a network six plain lights.
//
//   for (const auto& [name, map] : procedural_maps()) ...

#include "faceprobe/core/env_map.h"

#include <string>
#include <utility>
#include <vector>

namespace faceprobe::synth {

// 256 x 128 each, mean radiance about 1.
std::vector<std::pair<std::string, EnvMap>> procedural_maps();

}  // namespace faceprobe::synth

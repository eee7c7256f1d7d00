#pragma once
// Internal: the small bright lights of a map, such as the sun and bulbs, told apart from everything that has a size.

#include "faceprobe/core/env_map.h"
#include "faceprobe/synth/light_sample.h"

#include <vector>

namespace faceprobe::synth {

struct FoundLights {
  std::vector<DistantLight> lights;  // brightest peak first
  EnvMap rest;                       // the map without them; never above it
};

// At most `max_count` lights within `max_radius` radians of their middle. What is taken out of the map is exactly what the lights
// hold, channel by channel.
FoundLights find_lights(const EnvMap& map, int max_count, float max_radius);

}  // namespace faceprobe::synth

#pragma once
// The maps of the comparison, from overcast to hard sun, each turned so that its brightest spot shines on the face from the side.

#include "faceprobe/core/env_map.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct NamedMap {
  std::string name;
  std::string kind;             // "overcast", "room", "studio", "sun"
  double peak_over_mean = 0;    // brightest texel's luminance over the map's mean
  double peak_azimuth_deg = 0;  // camera frame, after the turn
  double peak_elevation_deg = 0;
  EnvMap radiance;  // camera frame
};

// The first `count` (of 8) maps of DATA/hdri/train. Turned by whole columns, so no texel's value changes.
std::vector<NamedMap> load_maps(const std::filesystem::path& data, int count);

// Dim grey all around and a red lamp at camera right.
NamedMap red_lamp(int height);

}  // namespace faceprobe::bench

#pragma once
// The light of the comparison: photographed maps, and one that needs no file.

#include "faceprobe/core/env_map.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct TestMap {
  std::string name;
  EnvMap radiance;  // 256 x 128, camera frame
};

// An even sky with one small sun. After the first `count` of three maps of `folder`, each turned so that its brightest spot is before the
// thing; none when `folder` is empty. Throws Error(kInput) when one is missing.
std::vector<TestMap> test_maps(const std::filesystem::path& folder, int count);

}  // namespace faceprobe::bench

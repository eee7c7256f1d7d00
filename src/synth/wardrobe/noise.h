#pragma once
// Smooth noise in space, from a seed.

#include "faceprobe/core/smooth_step.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace faceprobe::synth {

inline float lattice_value(std::uint64_t seed, int x, int y, int z) {
  std::uint64_t h = seed ^ (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) * 0x9E3779B97F4A7C15ULL) ^
                    (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) * 0xC2B2AE3D27D4EB4FULL) ^
                    (static_cast<std::uint64_t>(static_cast<std::uint32_t>(z)) * 0x165667B19E3779F9ULL);
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;  // SplitMix64's finaliser
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  h ^= h >> 31;
  return static_cast<float>(h >> 40) / 8388608.0F - 1.0F;
}

// Value noise with unit lattice, -1 .. 1.
inline float noise(std::uint64_t seed, const Eigen::Vector3f& p) {
  const Eigen::Array3f floor = p.array().floor();
  const Eigen::Array3i c = floor.cast<int>();
  const Eigen::Array3f f = p.array() - floor;
  const Eigen::Array3f t = f * f * (3.0F - 2.0F * f);
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1;
    const int dy = (corner >> 1) & 1;
    const int dz = corner >> 2;
    const float w = (dx != 0 ? t.x() : 1 - t.x()) * (dy != 0 ? t.y() : 1 - t.y()) * (dz != 0 ? t.z() : 1 - t.z());
    sum += w * lattice_value(seed, c.x() + dx, c.y() + dy, c.z() + dz);
  }
  return sum;
}

inline Eigen::Vector3f noise3(std::uint64_t seed, const Eigen::Vector3f& p) {
  return {noise(seed, p), noise(seed + 1, p), noise(seed + 2, p)};
}

}  // namespace faceprobe::synth

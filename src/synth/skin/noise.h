#pragma once
// Noise in space that depends on nothing but the place and a key: lattice points are hashed, never stored, so points may come in any
// order on any thread.

#include <Eigen/Core>
#include <cstdint>

namespace faceprobe::synth {

struct Cell {
  std::int32_t x, y, z;
};

// Well-mixed bits of a lattice point (the finaliser of MurmurHash3, Appleby 2011).
inline std::uint32_t cell_bits(const Cell& cell, std::uint32_t key) {
  std::uint32_t h = key ^ (static_cast<std::uint32_t>(cell.x) * 0x8DA6B343U) ^
                    (static_cast<std::uint32_t>(cell.y) * 0xD8163841U) ^
                    (static_cast<std::uint32_t>(cell.z) * 0xCB1AB31FU);
  h = (h ^ (h >> 16U)) * 0x85EBCA6BU;
  h = (h ^ (h >> 13U)) * 0xC2B2AE35U;
  return h ^ (h >> 16U);
}

// [0, 1) from the upper bits.
inline float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

// A key for one purpose of a 64-bit seed.
std::uint32_t noise_key(std::uint64_t seed, std::uint32_t purpose);

// Smooth noise with features about one unit wide: mean 0, variance 1 over space (values between lattice points blended with a
// quintic). In about [-3, 3].
float value_noise(const Eigen::Vector3f& point, std::uint32_t key);

// Gradient (per unit) of Perlin's improved noise (2002), scaled so that each component has mean square 1 over space.
Eigen::Vector3f noise_gradient(const Eigen::Vector3f& point, std::uint32_t key);

}  // namespace faceprobe::synth

#include "synth/sensor/noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Constants of C. Wellons' search for 32-bit mixers ("lowbias32", public domain); half the key goes in between the rounds.
inline std::uint32_t hashed(std::uint32_t number, std::uint32_t key, std::uint32_t second_key) {
  std::uint32_t x = number * 0x9E3779B9U + key;
  x = (x ^ (x >> 16U)) * 0x7FEB352DU + second_key;
  x = (x ^ (x >> 15U)) * 0x846CA68BU;
  return x ^ (x >> 16U);
}

// SplitMix64's last step (Steele et al. 2014): keys that differ in one bit become unrelated.
inline std::uint64_t spread(std::uint64_t key) {
  key = (key ^ (key >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  key = (key ^ (key >> 27U)) * 0x94D049BB133111EBULL;
  return key ^ (key >> 31U);
}

// Of a number in (0, 1): 2 artanh((m - 1) / (m + 1)) for the mantissa m in [.71, 1.42), to 2e-7.
inline float fast_log(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t shifted = bits - 0x3F3504F3U;  // bits of the root of one half
  const auto exponent = static_cast<std::int32_t>(shifted) >> 23;
  const float mantissa = std::bit_cast<float>(bits - (static_cast<std::uint32_t>(exponent) << 23U));
  const float s = (mantissa - 1.0F) / (mantissa + 1.0F);
  const float s2 = s * s;
  const float series = 2.0F + s2 * (0.66666667F + s2 * (0.4F + s2 * 0.28571429F));
  return static_cast<float>(exponent) * 0.69314718F + s * series;
}

// sin(2 pi turn) for |turn| <= 1/4: Taylor's series, to 4e-6.
inline float fast_sine(float turn) {
  const float a = 6.2831853F * turn;
  const float a2 = a * a;
  return a * (1.0F + a2 * (-1.6666667e-1F + a2 * (8.3333333e-3F + a2 * (-1.9841270e-4F + a2 * 2.7557319e-6F))));
}

}  // namespace

// Box & Muller 1958; blocks of 2 x 64 so that the loop has no branches and the pairs of deviates lie next to each other.
void fill_normals(float* out, std::size_t count, std::uint64_t key) {
  constexpr std::size_t kHalf = 64;
  const std::uint64_t mixed = spread(key + 0x9E3779B97F4A7C15ULL);
  const auto low = static_cast<std::uint32_t>(mixed);
  const auto high = static_cast<std::uint32_t>(mixed >> 32U);
  std::array<float, 2 * kHalf> block;
  for (std::size_t first = 0; first < count; first += 2 * kHalf) {
    const auto number = static_cast<std::uint32_t>(first);
    for (std::uint32_t i = 0; i < kHalf; ++i) {
      const std::uint32_t a = hashed(number + 2 * i, low, high) >> 8U;
      const std::uint32_t b = hashed(number + 2 * i + 1, low, high) >> 8U;
      const float uniform = (static_cast<float>(static_cast<std::int32_t>(a)) + 0.5F) * 0x1p-24F;  // (0, 1)
      const float turn = static_cast<float>(static_cast<std::int32_t>(b)) * 0x1p-24F - 0.5F;       // [-1/2, 1/2)
      const float radius = std::sqrt(std::max(0.0F, -2.0F * fast_log(uniform)));
      const float size = std::abs(turn);
      block[i] = radius * fast_sine(0.25F - size);
      block[i + kHalf] = radius * std::copysign(fast_sine(std::min(size, 0.5F - size)), turn);
    }
    std::copy_n(block.data(), std::min(2 * kHalf, count - first), out + first);
  }
}

}  // namespace faceprobe::synth

#pragma once
// Well-spread random numbers in [0, 1): the first two dimensions of Sobol's sequence, scrambled as Owen does by hashing (Burley 2020,
// "Practical hash-based Owen scrambling"; the mixing step is Laine & Karras 2011's as improved by N. Vegdahl). Every pair of dimensions is a
// sequence of its own, padded as in Burley 2020, and everything follows from pixel, seed and sample number.
//
//   SobolSampler random(pixel_key, sample);
//   const Eigen::Vector2f uv = random.pair();

#include <Eigen/Core>
#include <cstdint>

namespace faceprobe::render {

inline std::uint32_t reversed_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

// Each bit of the result depends on the bits below it alone: a nested scrambling of numbers whose first digit is the lowest bit.
inline std::uint32_t mixed_upwards(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

inline std::uint32_t hashed(std::uint32_t x) {  // Ellis 2018's "lowbias32"
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}
inline std::uint32_t hashed(std::uint32_t a, std::uint32_t b) {
  return hashed(a ^ (hashed(b) + 0x9e3779b9U + (a << 6)));
}

// Digits of Sobol's second dimension, lowest bit first, from those of the index: its matrix is Pascal's triangle modulo 2, where
// binom(j, i) is odd when the bits of i are among those of j (Lucas), so that each digit is a sum over the supersets of its number.
inline std::uint32_t sobol_second(std::uint32_t digits) {
  digits ^= (digits >> 1) & 0x55555555U;
  digits ^= (digits >> 2) & 0x33333333U;
  digits ^= (digits >> 4) & 0x0f0f0f0fU;
  digits ^= (digits >> 8) & 0x00ff00ffU;
  return digits ^ ((digits >> 16) & 0x0000ffffU);
}

class SobolSampler {
 public:
  SobolSampler(std::uint32_t key, std::uint32_t sample) : key_(key), reversed_sample_(reversed_bits(sample)) {}

  Eigen::Vector2f pair() {
    const std::uint32_t seed = hashed(key_, ++dimension_);
    const std::uint32_t index = reversed_bits(mixed_upwards(reversed_sample_, seed));
    return {fraction(mixed_upwards(index, hashed(seed, 1))),
            fraction(mixed_upwards(sobol_second(index), hashed(seed, 2)))};
  }
  float one() { return pair().x(); }

 private:
  static float fraction(std::uint32_t digits) { return static_cast<float>(reversed_bits(digits) >> 8) * 0x1p-24F; }

  std::uint32_t key_;
  std::uint32_t reversed_sample_;
  std::uint32_t dimension_ = 0;
};

}  // namespace faceprobe::render

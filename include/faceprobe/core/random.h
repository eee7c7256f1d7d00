#pragma once
// Random numbers that depend on nothing but their key: two generators of the same key give the same sequence on every machine, and
// any number of them can be made in any order on any thread. A key is a seed and a path of numbers under it, such as {seed,
// sample, purpose}; different paths give unrelated sequences.
//
// PCG XSH RR 64/32 (O'Neill 2014, HMC-CS-2014-0905), its state and stream drawn from the key by SplitMix64 (Steele et al. 2014).
// The standard library's distributions are not used: their results differ between implementations.
//
// Not for secrets.
//
//   Random random({seed, 17});
//   const double roughness = random.between(0.2, 0.4);

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>

namespace faceprobe {

class Random {
 public:
  // A seed and the path under it.
  Random(std::initializer_list<std::uint64_t> key);

  std::uint32_t bits();                          // 32 of them
  double uniform();                              // [0, 1)
  double between(double low, double high);       // [low, high)
  double log_between(double low, double high);   // uniform in the logarithm; 0 < low <= high
  double normal();                               // mean 0, variance 1 (Box-Muller)
  double normal(double mean, double deviation);  // of that mean and standard deviation
  int below(int count);                          // 0 .. count - 1; count >= 1
  bool chance(double probability);               // true with that probability, 0..1
  Eigen::Vector3f direction();                   // uniform on the sphere

  // A generator of its own for a part of the work; drawing from it leaves this one as it is.
  Random split(std::uint64_t purpose) const;

 private:
  Random(std::uint64_t state, std::uint64_t stream) : state_(state), stream_(stream), key_(state) {}

  std::uint64_t state_ = 0;
  std::uint64_t stream_ = 1;
  std::uint64_t key_ = 0;
};

}  // namespace faceprobe

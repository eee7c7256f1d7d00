#include "faceprobe/core/random.h"

#include "faceprobe/core/angles.h"

#include <cassert>
#include <cmath>

namespace faceprobe {
namespace {

std::uint64_t split_mix(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

std::uint64_t mix_in(std::uint64_t key, std::uint64_t number) {
  std::uint64_t state = key ^ (number + 0x632BE59BD9B4E019ULL + (key << 6U) + (key >> 2U));
  return split_mix(state);
}

}  // namespace

Random::Random(std::initializer_list<std::uint64_t> key) {
  std::uint64_t mixed = key.size();
  for (const std::uint64_t number : key) mixed = mix_in(mixed, number);
  key_ = mixed;
  state_ = split_mix(mixed);
  stream_ = split_mix(mixed) | 1U;
}

Random Random::split(std::uint64_t purpose) const {
  std::uint64_t mixed = mix_in(key_, purpose);
  Random child(0, 1);
  child.key_ = mixed;
  child.state_ = split_mix(mixed);
  child.stream_ = split_mix(mixed) | 1U;
  return child;
}

std::uint32_t Random::bits() {
  const std::uint64_t old = state_;
  state_ = old * 6364136223846793005ULL + stream_;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
  const auto rotation = static_cast<std::uint32_t>(old >> 59U);
  return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
}

double Random::uniform() {
  const std::uint64_t high = bits() >> 5U;  // 27 bits, then 26: as many as a double holds
  const std::uint64_t low = bits() >> 6U;
  return static_cast<double>((high << 26U) | low) * 0x1p-53;
}

double Random::between(double low, double high) { return low + (high - low) * uniform(); }

double Random::log_between(double low, double high) {
  assert(low > 0 && high >= low);
  return low * std::exp(std::log(high / low) * uniform());
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * kPi * uniform());
}

double Random::normal(double mean, double deviation) { return mean + deviation * normal(); }

int Random::below(int count) {
  assert(count >= 1);
  // Lemire 2019 without the rejection step: the bias is under count / 2^32.
  return static_cast<int>((static_cast<std::uint64_t>(bits()) * static_cast<std::uint64_t>(count)) >> 32U);
}

bool Random::chance(double probability) { return uniform() < probability; }

Eigen::Vector3f Random::direction() {
  const double z = between(-1.0, 1.0);
  const double phi = 2.0 * kPi * uniform();
  const double r = std::sqrt(1.0 - z * z);
  return Eigen::Vector3d(r * std::cos(phi), r * std::sin(phi), z).cast<float>();
}

}  // namespace faceprobe

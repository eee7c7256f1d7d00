#include "insert/grain_levels.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::insert {
namespace {

constexpr float kMostCorrelationPx = 16;
constexpr float kMostPerLevel = 2;  // sigma's ratio between neighbouring levels
// Deviation of rounding to 8 bits. A level with less was smoothed or painted, and does not speak for the others.
constexpr float kRounding = 0.29F / 255;

}  // namespace

float Grain::sigma_at(float brightness) const {
  const float last = static_cast<float>(sigma.size() - 1);
  const float place = std::clamp(brightness * static_cast<float>(sigma.size()) - 0.5F, 0.0F, last);
  const auto below = std::min(static_cast<std::size_t>(place), sigma.size() - 2);
  return sigma[below] + (place - static_cast<float>(below)) * (sigma[below + 1] - sigma[below]);
}

std::string Grain::validate() const {
  const auto within = [](float value, float most) { return value >= 0 && value <= most; };  // NaN is not
  for (const float value : sigma) {
    if (!within(value, 1)) return "Grain's sigma must be 0 to 1.";
  }
  if (!within(correlation_px, kMostCorrelationPx) || !within(colour_correlation_px, kMostCorrelationPx)) {
    return "Grain's correlation must be 0 to 16 pixels.";
  }
  if (!within(colour, kMostColour)) return "Grain's colour must be 0 to 100.";
  return {};
}

std::size_t level_of(double brightness) {
  return std::min(static_cast<std::size_t>(brightness * static_cast<double>(kLevels)), kLevels - 1);
}

KnownSigma held(const KnownSigma& known) {
  KnownSigma result = known;
  for (std::size_t i = 0; i < kLevels; ++i) {
    for (std::size_t j = 0; j < kLevels; ++j) {
      if (!known[i] || !known[j]) continue;
      const float most =
          std::max(*known[j], kRounding) * std::pow(kMostPerLevel, static_cast<float>(i > j ? i - j : j - i));
      result[i] = std::min(*result[i], most);
    }
  }
  return result;
}

std::array<float, kLevels> filled(const KnownSigma& known) {
  std::array<float, kLevels> sigma{};
  for (std::size_t i = 0; i < kLevels; ++i) {
    std::size_t before = i;
    std::size_t after = i;
    while (before > 0 && !known[before]) --before;
    while (after + 1 < kLevels && !known[after]) ++after;
    const float low = known[before].value_or(known[after].value_or(0));
    const float high = known[after].value_or(low);
    const float part = after > before ? static_cast<float>(i - before) / static_cast<float>(after - before) : 0.0F;
    sigma[i] = low + part * (high - low);
  }
  return sigma;
}

}  // namespace faceprobe::insert

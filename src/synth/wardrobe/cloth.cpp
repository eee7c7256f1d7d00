#include "synth/wardrobe/cloth.h"

#include "synth/wardrobe/noise.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {

Eigen::Vector3f draw_dye(Random& random) {
  const double kind = random.uniform();
  if (kind < 0.25) return Eigen::Vector3f::Constant(static_cast<float>(random.between(0.01, 0.06)));  // black
  if (kind < 0.45) return Eigen::Vector3f::Constant(static_cast<float>(random.between(0.5, 0.8)));    // white
  if (kind < 0.60) return Eigen::Vector3f::Constant(static_cast<float>(random.between(0.1, 0.35)));   // grey
  if (kind < 0.75) {                                                                                  // navy, denim
    const auto level = static_cast<float>(random.between(0.5, 2.0));
    return Eigen::Vector3f(0.03F, 0.05F, 0.12F) * level;
  }
  // Any hue, seldom loud.
  const double hue = random.uniform() * 6.0;
  const auto strength = static_cast<float>(random.between(0.3, 0.9));
  const auto value = static_cast<float>(random.log_between(0.05, 0.6));
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return value * (1.0F - strength * static_cast<float>(std::clamp(std::min(k, 4.0 - k), 0.0, 1.0)));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

Cloth draw_cloth(Random& random, bool patterned) {
  Cloth cloth;
  cloth.colour = draw_dye(random);
  cloth.second = draw_dye(random);
  cloth.period_m = static_cast<float>(random.log_between(0.015, 0.06));
  cloth.weave = static_cast<float>(random.between(0.04, 0.14));
  cloth.seed = random.bits();
  const double kind = random.uniform();
  if (patterned && kind < 0.18) cloth.pattern = Cloth::Pattern::kStripes;
  if (patterned && kind > 0.88) cloth.pattern = Cloth::Pattern::kChecks;
  return cloth;
}

Eigen::Vector3f Cloth::at(const Eigen::Vector3f& p) const {
  // Soft edges: the colours live on vertices and are not to alias.
  const auto band = [this](float x) {
    const float t = x / period_m - std::floor(x / period_m);
    return smooth_step(0.2F, 0.35F, t) * smooth_step(0.8F, 0.65F, t);
  };
  float share = 0;
  if (pattern == Pattern::kStripes) share = band(p.y());
  if (pattern == Pattern::kChecks) share = 0.5F * (band(p.y()) + band(p.x()));
  const Eigen::Vector3f base = colour + share * (second - colour);
  return base * (1.0F + weave * (noise(seed, p / 0.004F) + 0.6F * noise(seed + 1, p / 0.02F)));
}

}  // namespace faceprobe::synth

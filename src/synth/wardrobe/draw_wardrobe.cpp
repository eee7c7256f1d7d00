#include "faceprobe/synth/wardrobe.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Picks an index by weights that sum to about 1.
template <std::size_t N>
std::size_t pick(const std::array<double, N>& weights, Random& random) {
  double at = random.uniform();
  for (std::size_t i = 0; i + 1 < N; ++i) {
    at -= weights[i];
    if (at < 0) return i;
  }
  return N - 1;
}

Eigen::Vector3f draw_hair_colour(Random& random) {
  struct Tint {
    Eigen::Vector3f low, high;
  };
  static const std::array<Tint, 7> kTints = {{
      {{0.006F, 0.005F, 0.005F}, {0.016F, 0.012F, 0.010F}},  // black
      {{0.018F, 0.010F, 0.006F}, {0.045F, 0.024F, 0.013F}},  // dark brown
      {{0.045F, 0.025F, 0.013F}, {0.12F, 0.070F, 0.036F}},   // brown
      {{0.17F, 0.11F, 0.055F}, {0.46F, 0.33F, 0.19F}},       // blond
      {{0.09F, 0.025F, 0.008F}, {0.28F, 0.10F, 0.03F}},      // red
      {{0.10F, 0.10F, 0.10F}, {0.45F, 0.45F, 0.46F}},        // grey, white
      {{0.02F, 0.02F, 0.02F}, {0.4F, 0.4F, 0.4F}},           // dyed: any
  }};
  static constexpr std::array<double, 7> kShares = {0.30, 0.24, 0.18, 0.12, 0.05, 0.10, 0.01};
  const std::size_t kind = pick(kShares, random);
  const Tint& tint = kTints[kind];
  if (kind == 6) {
    return {static_cast<float>(random.between(0.01, 0.4)), static_cast<float>(random.between(0.01, 0.3)),
            static_cast<float>(random.between(0.01, 0.4))};
  }
  const auto t = static_cast<float>(random.uniform());
  const auto warm = static_cast<float>(random.between(0.93, 1.07));
  Eigen::Vector3f colour = tint.low + t * (tint.high - tint.low);
  colour.x() *= warm;
  colour.z() /= warm;
  return colour;
}

}  // namespace

WardrobeSettings draw_wardrobe(Random& random) {
  WardrobeSettings settings;
  //                                          bald  buzz  short parted fringe long  curly tied
  static constexpr std::array<double, 8> kCuts = {0.07, 0.10, 0.25, 0.13, 0.10, 0.16, 0.09, 0.10};
  settings.cut = static_cast<HairCut>(pick(kCuts, random));
  settings.hair_colour = draw_hair_colour(random);
  // Beards go with any hair: the head's shape says nothing about who grows one. With long hair they are rare.
  const bool seldom =
      settings.cut == HairCut::kLong || settings.cut == HairCut::kFringe || settings.cut == HairCut::kTied;
  if (random.chance(seldom ? 0.04 : 0.28)) {
    settings.beard = static_cast<float>(random.between(0.15, 1.0));
    settings.moustache = static_cast<float>(random.between(0.2, 1.0));
  } else if (random.chance(seldom ? 0.005 : 0.03)) {
    settings.moustache = static_cast<float>(random.between(0.3, 1.0));
  }
  settings.headwear = static_cast<Headwear>(pick(std::array<double, 4>{0.90, 0.035, 0.035, 0.03}, random));
  settings.glasses = static_cast<Glasses>(pick(std::array<double, 4>{0.77, 0.08, 0.12, 0.03}, random));
  settings.held = static_cast<Held>(pick(std::array<double, 6>{0.90, 0.015, 0.035, 0.01, 0.015, 0.025}, random));
  if (settings.headwear == Headwear::kScarf) settings.beard = settings.moustache = 0.0F;
  if (settings.held == Held::kMask) settings.beard = std::min(settings.beard, 0.35F);  // a full one would grow through
  settings.skin_tone *= static_cast<float>(random.between(0.5, 1.2));
  settings.seed = (static_cast<std::uint64_t>(random.bits()) << 32) | random.bits();
  return settings;
}

}  // namespace faceprobe::synth

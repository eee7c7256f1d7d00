#pragma once
// More environment maps from a few: each is two of them at a ratio, turned against one another and mirrored by chance, their contrasts changed,
// and lamps beside them. A network that learns light from seventy maps learns those seventy by heart; their mixtures are lights that nobody
// photographed, with contrasts, colours and numbers of lights that occur.
//
//   std::vector<NamedMap> maps = assets::load_maps(folder);
//   for (NamedMap& mixed : mixed_maps(maps, {.count = 300, .seed = 7})) maps.push_back(std::move(mixed));
//
// Not for backgrounds that anybody looks at, which are double exposures, nor for measuring, which wants lights that were there.

#include "faceprobe/core/env_map.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::synth {

// A map and what it is called.
using NamedMap = std::pair<std::string, EnvMap>;

// How mixed maps are drawn.
struct MixOptions {
  int count = 0;           // maps to make, 0 .. 10000
  std::uint64_t seed = 1;  // the same seed makes the same maps
  double second = 0.5;     // at most this share of a mixture's energy, before lamps, is the second map's; 0 .. 1
  double contrast =
      0.25;  // deviation of the logarithm of the exponent that luminance is taken to; 0 .. 1, exponents stay in 0.6 .. 1.5
  double lamps = 0.5;  // probability of one lamp; half of it is that of two; 0 .. 1

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// Each of the first map's size, of positive mean, named after both. None for no maps. Throws std::invalid_argument for options that do not
// validate, Error(kInput) for a map of no light.
std::vector<NamedMap> mixed_maps(std::span<const NamedMap> maps, const MixOptions& options);

}  // namespace faceprobe::synth

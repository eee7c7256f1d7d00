#pragma once
// A grain's levels of brightness: which one a brightness belongs to, and what to make of those a photo shows badly or not at all.
//
//   KnownSigma known;
//   known[level_of(0.35)] = 0.01F;
//   const Grain grain{.sigma = filled(held(known))};

#include "faceprobe/insert/photo_look.h"

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>

namespace faceprobe::insert {

inline constexpr std::size_t kLevels = std::tuple_size_v<decltype(Grain::sigma)>;
using KnownSigma = std::array<std::optional<float>, kLevels>;

std::size_t level_of(double brightness);

// To the lower envelope of the levels, as in Liu et al. 2008 ("Automatic estimation and removal of noise from a single image", PAMI
// 30): a level shown by nothing but texture, hair for instance, stands out from the others by more than grain does.
KnownSigma held(const KnownSigma& known);

// Unknown levels between, or as, the known ones; 0 where none is.
std::array<float, kLevels> filled(const KnownSigma& known);

}  // namespace faceprobe::insert

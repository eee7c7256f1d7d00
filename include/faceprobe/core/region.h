#pragma once
// What a pixel of a picture of a person is. The first ten are the skin regions that reflectance statistics are given for (Weyrich
// et al. 2006, "Analysis of human faces using a measurement-based skin reflectance model"); the rest is not skin.
//
//   if (is_probe_skin(static_cast<Region>(regions(x, y)))) ...        // `regions`: H x W x 1

#include <array>
#include <cstdint>
#include <string_view>

namespace faceprobe {

// The values of region pictures; files keep the numbers.
enum class Region : std::uint8_t {
  kNone = 0,  // neither face nor person: background
  kForehead,
  kNose,
  kCheeks,
  kUpperLip,
  kLips,
  kChin,
  kJaw,
  kEyelids,
  kBrows,
  kOther,  // the ten skin regions; this one is temples, ears, scalp, neck
  kEyes,
  kMouth,    // eyeballs; between the lips
  kHair,     // on the head or the face, brows apart
  kGlasses,  // frames and lenses
  kObject,   // in front of the face: a hand, a phone, a mask
  kClothes,
};
inline constexpr int kRegionCount = 17;
inline constexpr int kSkinRegionCount = 10;

std::string_view region_name(Region region);               // "forehead", ...
std::array<std::uint8_t, 3> region_colour(Region region);  // sRGB, for pictures
// One of the ten skin regions. False for bytes that are no region.
constexpr bool is_skin(Region region) { return region >= Region::kForehead && region <= Region::kOther; }
// Skin whose highlights can be used: the ten regions without lips and brows.
constexpr bool is_probe_skin(Region region) {
  return is_skin(region) && region != Region::kLips && region != Region::kBrows;
}

}  // namespace faceprobe

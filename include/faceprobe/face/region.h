#pragma once
// What a pixel of a face is. The first ten are the skin regions that reflectance statistics are given for (Weyrich et
// al. 2006, "Analysis of human faces using a measurement-based skin reflectance model"); the rest is not skin.

#include "faceprobe/face/canonical_mesh.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace faceprobe::face {

enum class Region : std::uint8_t {
  kNone = 0,  // not face
  kForehead,
  kNose,
  kCheeks,
  kUpperLip,
  kLips,
  kChin,
  kJaw,
  kEyelids,
  kBrows,
  kOther,  // the ten skin regions
  kEyes,
  kMouth,  // eyeballs; between the lips
};
inline constexpr int kRegionCount = 13;

std::string_view region_name(Region region);               // "forehead", ...
std::array<std::uint8_t, 3> region_colour(Region region);  // sRGB, for pictures
// Skin whose highlights can be used: the ten regions without lips and brows.
bool is_probe_skin(Region region);

// Region of each triangle of the canonical mesh, from landmark rings (eyes, lips, brows) and the canonical shape.
std::vector<Region> triangle_regions(const CanonicalMesh& mesh);

}  // namespace faceprobe::face

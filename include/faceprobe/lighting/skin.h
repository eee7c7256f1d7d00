#pragma once
// How skin mirrors light, by region of the face. The ten regions are those of Weyrich et al. 2006 ("Analysis of human faces
// using a measurement-based skin reflectance model"), whose tables are not public in numbers.
//
// ESTIMATE, not measurement: the values below keep the order that the paper's plots and later renderers agree on (nose and
// forehead smoother and shinier, beard area rougher) around the common default m = .30, rho_s = .18. Only the ratios between
// regions matter to a light estimate, because one gain for all highlights is fitted.

#include <array>
#include <string_view>

namespace faceprobe::lighting {

enum class SkinRegion { kForehead, kNose, kCheeks, kUpperLip, kLips, kChin, kJaw, kEyelids, kBrows, kOther };
inline constexpr int kSkinRegionCount = 10;

struct SkinReflectance {
  float roughness;        // m, rms slope of the Beckmann distribution
  float specular_albedo;  // rho_s of the Torrance-Sparrow model, see core/microfacet.h
};

SkinReflectance skin_reflectance(SkinRegion region);

// Phong exponent of the reflection vector's lobe (R . L)^alpha that has the width of a Beckmann lobe of roughness m:
// n = 2 / m^2 - 2 for the half vector, a quarter of it for the mirror direction.
float phong_exponent(float roughness);

}  // namespace faceprobe::lighting

#pragma once
// How skin mirrors light, by region of the face. The ten regions are those of Weyrich et al. 2006 ("Analysis of human faces
// using a measurement-based skin reflectance model"), whose tables are not public in numbers.
//
// ESTIMATE, not measurement: the values below keep the order that the paper's plots and later renderers agree on (nose and
// forehead smoother and shinier, beard area rougher) around the common default m = .30, rho_s = .18. Only the ratios between
// regions matter to a light estimate, because one gain for all highlights is fitted.
//
//   const auto [roughness, specular_albedo] = skin_reflectance(Region::kNose);

#include "faceprobe/core/region.h"

namespace faceprobe {

struct SkinReflectance {
  float roughness;        // m, rms slope of the Beckmann distribution
  float specular_albedo;  // rho_s of the Torrance-Sparrow model, see core/microfacet.h
};

// One of the ten skin regions; any other region gets the values of Region::kOther.
SkinReflectance skin_reflectance(Region region);

}  // namespace faceprobe

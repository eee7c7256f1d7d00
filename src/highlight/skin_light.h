#pragma once
// Internal: the light of skin_subspace. Given each pixel's highlight and pigments, what shading fits; given that, what colour the skin
// has under it and what a pixel's highlight is made of.

#include "highlight/skin_pixel.h"

#include <vector>

namespace faceprobe::highlight {

struct SkinLight {
  ShadingModel shading;
  Eigen::Vector3f log_skin;  // log albedo of this person's skin
};

// From nothing but the mean colour of the pixels.
SkinLight first_skin_light(const std::vector<SkinPixel>& pixels);
// Least squares in each channel, the rest (picture less highlight) relative to what it is expected to be, so that the dark side has as
// much say; pixels far from the fit have less. `first`: before any highlight is known, what is too bright has less say instead.
void fit_skin_light(const std::vector<SkinPixel>& pixels, bool first, int threads, SkinLight& light);
// Writes shading, light and expected highlight of each pixel.
void light_skin(const SkinLight& light, float highlight_share, int threads, std::vector<SkinPixel>& pixels);

}  // namespace faceprobe::highlight

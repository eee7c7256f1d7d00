#pragma once
// Slow shading of a skin texture: what of its lightness goes with the direction that the surface faces.

#include "faceprobe/core/image.h"

namespace faceprobe::pipeline {

// Fits log luminance by second-order spherical harmonics of the normal, robustly, so that brows, lips and beards are no shading, and
// divides it out of `colour` (H x W x 3, linear); the weighted mean level stays. `normal`: H x W x 3; `weight`: H x W x 1, where and
// how much to look. Returns the weighted standard deviation of the log shading taken out.
double remove_slow_shading(const Image& normal, const Image& weight, Image& colour);

}  // namespace faceprobe::pipeline

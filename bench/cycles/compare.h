#pragma once
// Masks and errors of two pictures of the same face.

#include "faceprobe/core/image.h"

#include <vector>

namespace faceprobe::bench {

// Pixels (y * width + x) where `inside` is 1 and stays so within `margin_px` in every direction; picture edges count as outside.
std::vector<int> eroded_pixels(const ByteImage& inside, int margin_px);

// sqrt(mean (a - b)^2) / sqrt(mean b^2) over pixels and channels, with the pixels' values in rows of three.
double relative_rmse(const Image& a, const Image& b, const std::vector<int>& pixels);

// a - b over the pixels as a signed picture: grey = equal, white and black = off by `full_scale` (of the mean of b).
ByteImage difference_picture(const Image& a, const Image& b, const std::vector<int>& pixels, double full_scale);

}  // namespace faceprobe::bench

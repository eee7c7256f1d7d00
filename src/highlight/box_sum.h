#pragma once
// Internal: sums over squares, as often as wished: a fast stand-in for a wide Gaussian.

#include "faceprobe/core/image.h"

namespace faceprobe::highlight {

// Every value becomes the sum over the square of 2 radius + 1 pixels around it, cut at the borders. radius >= 0. Any number of threads
// gives the same result.
void box_sum(Image& image, int radius, int threads);

}  // namespace faceprobe::highlight

#pragma once
// Pictures resampled for the networks, by OpenCV where it is linked, else by the plain functions, which do the same more slowly. OpenCV's
// places of samples are rounded to 1/32 px; the plain ones are exact.

#include "faceprobe/core/image.h"

#include <Eigen/Core>

namespace faceprobe::face {

using Affine = Eigen::Matrix<double, 2, 3>;

namespace plain {

// Half as wide and high, rounded down: means of 2 x 2 pixels. An odd last column or row is left out. At least 2 x 2 px.
Image half_size(const Image& picture);
// size x size samples, bilinear between pixels' centres, black outside. Sample (x, y) is taken at source_from_sample * (x, y, 1); both
// count from the first pixel's centre.
Image warp_square(const Image& picture, const Affine& source_from_sample, int size);

}  // namespace plain

#ifdef FACEPROBE_WITHOUT_OPENCV
using plain::half_size;
using plain::warp_square;
#else
Image half_size(const Image& picture);
Image warp_square(const Image& picture, const Affine& source_from_sample, int size);
#endif

}  // namespace faceprobe::face

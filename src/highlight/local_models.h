#pragma once
// Around every pixel of a picture, its highlight as an affine function of its colour.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::highlight {

// (highlight, 1) = model * (picture, 1).
using Model = Eigen::Matrix4f;

struct Small {
  const Image& highlight;   // h x w x 3
  const Image& picture;     // h x w x 3
  const ByteImage& usable;  // h x w x 1, non-zero where both may be learnt from
};

// Row-major, one model for each pixel: the mean of those fitted in the windows of 2 radius + 1 pixels that it is in. Zero where
// none of them holds a usable pixel. `epsilon` is added to the variance of the colours.
std::vector<Model> fit_local_models(const Small& small, int radius, double epsilon, int threads);

}  // namespace faceprobe::highlight

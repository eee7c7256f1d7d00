#pragma once
// A photo that has no colour but for its compression's rounding: exactly grey, so that nothing after it finds a colour.

#include "faceprobe/core/color.h"
#include "faceprobe/core/image.h"

#include <algorithm>

namespace faceprobe::pipeline {

// Three channels; each pixel becomes its luminance.
inline void take_colour_off(Image& picture) {
  for (std::size_t i = 0; i < picture.values().size(); i += 3) {
    float* pixel = picture.data() + i;
    std::fill_n(pixel, 3, luminance(pixel));
  }
}

}  // namespace faceprobe::pipeline

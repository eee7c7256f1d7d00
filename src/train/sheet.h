#pragma once

#include "faceprobe/core/image.h"

#include <algorithm>

namespace faceprobe::train {

// `picture` into `sheet`, which has room for it; both of 3 channels.
inline void paste(const ByteImage& picture, int left, int top, ByteImage& sheet) {
  for (int y = 0; y < picture.height(); ++y) std::ranges::copy(picture.row(y), sheet.pixel(left, top + y));
}

}  // namespace faceprobe::train

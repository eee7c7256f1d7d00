#pragma once
// Left and right of a picture change places.
//
//   mirror(picture);
//   const Image other_way = mirrored(picture);

#include "faceprobe/core/image.h"

#include <algorithm>

namespace faceprobe {

// In place, any size and number of channels.
template <class T>
void mirror(BasicImage<T>& picture) {
  const int width = picture.width();
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < width / 2; ++x)
      std::swap_ranges(picture.pixel(x, y), picture.pixel(x, y) + picture.channels(), picture.pixel(width - 1 - x, y));
  }
}

// The mirror image, as large.
template <class T>
BasicImage<T> mirrored(BasicImage<T> picture) {
  mirror(picture);
  return picture;
}

}  // namespace faceprobe

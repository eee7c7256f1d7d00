#pragma once
// Pictures for the metrics.

#include "faceprobe/core/image.h"
#include "faceprobe/core/random.h"

namespace faceprobe::eval::testing {

// Values in [0, 1).
inline Image noise(int width, int height, int channels, std::uint64_t seed) {
  Image image(width, height, channels);
  Random random({seed});
  for (float& value : image.values()) value = static_cast<float>(random.uniform());
  return image;
}

// scale * image + offset
inline Image affine(Image image, float scale, float offset = 0) {
  for (float& value : image.values()) value = scale * value + offset;
  return image;
}

// The left half.
inline ByteImage left_half(int width, int height) {
  ByteImage mask(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width / 2; ++x) mask(x, y) = 255;
  }
  return mask;
}

}  // namespace faceprobe::eval::testing

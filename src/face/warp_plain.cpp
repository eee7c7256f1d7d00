#include "face/warp.h"

#include <cmath>

namespace faceprobe::face::plain {

Image half_size(const Image& picture) {
  Image half(picture.width() / 2, picture.height() / 2, picture.channels());
  const int channels = picture.channels();
  for (int y = 0; y < half.height(); ++y) {
    const float* above = picture.pixel(0, 2 * y);
    const float* below = picture.pixel(0, 2 * y + 1);
    float* to = half.pixel(0, y);
    for (int x = 0; x < half.width(); ++x) {
      for (int k = 0; k < channels; ++k) {
        const int left = 2 * x * channels + k;
        const int right = left + channels;
        to[x * channels + k] = 0.25F * ((above[left] + above[right]) + (below[left] + below[right]));
      }
    }
  }
  return half;
}

Image warp_square(const Image& picture, const Affine& source_from_sample, int size) {
  Image out(size, size, picture.channels());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Eigen::Vector2d at = source_from_sample * Eigen::Vector3d(x, y, 1);
      // Beyond a pixel's width outside all is black; also keeps the numbers below within an int.
      if (!(at.x() > -1 && at.y() > -1 && at.x() < picture.width() && at.y() < picture.height())) continue;
      const int left = static_cast<int>(std::floor(at.x()));
      const int top = static_cast<int>(std::floor(at.y()));
      const float across = static_cast<float>(at.x() - left);
      const float down = static_cast<float>(at.y() - top);
      const auto add = [&](int px, int py, float weight) {
        if (px < 0 || py < 0 || px >= picture.width() || py >= picture.height()) return;
        const float* from = picture.pixel(px, py);
        for (int k = 0; k < picture.channels(); ++k) out(x, y, k) += weight * from[k];
      };
      add(left, top, (1 - across) * (1 - down));
      add(left + 1, top, across * (1 - down));
      add(left, top + 1, (1 - across) * down);
      add(left + 1, top + 1, across * down);
    }
  }
  return out;
}

}  // namespace faceprobe::face::plain

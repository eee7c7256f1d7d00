#include "net/close_view.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::net {

std::optional<Window> close_window(const ByteImage& mask, int picture_px) {
  int left = mask.width();
  int right = 0;
  int top = mask.height();
  int bottom = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = std::max(bottom, y + 1);
    }
  }
  if (right <= left) return std::nullopt;
  const double scale = kCloseFill * picture_px / std::max(right - left, bottom - top);
  const double half = 0.5 * picture_px / scale;
  return Window{0.5 * (left + right) - half, 0.5 * (top + bottom) - half, scale, picture_px, picture_px};
}

Window whole_window(int width, int height, int picture_px) {
  const double scale = static_cast<double>(picture_px) / std::max(width, height);
  const auto scaled = [scale](int size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  return {0, 0, scale, scaled(width), scaled(height)};
}

}  // namespace faceprobe::net

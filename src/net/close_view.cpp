#include "net/close_view.h"

#include "faceprobe/core/pixel_box.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::net {

std::optional<Window> close_window(const ByteImage& mask, int picture_px) {
  const std::optional<PixelBox> box = box_of(mask);
  if (!box) return std::nullopt;
  const double scale = kCloseFill * picture_px / std::max(box->width(), box->height());
  const double half = 0.5 * picture_px / scale;
  return Window{0.5 * (box->left + box->right) - half, 0.5 * (box->top + box->bottom) - half, scale, picture_px,
                picture_px};
}

Window whole_window(int width, int height, int picture_px) {
  const double scale = static_cast<double>(picture_px) / std::max(width, height);
  const auto scaled = [scale](int size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  return {0, 0, scale, scaled(width), scaled(height)};
}

}  // namespace faceprobe::net

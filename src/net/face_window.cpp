#include "faceprobe/net/face_window.h"

#include "faceprobe/core/pixel_box.h"

#include <algorithm>

namespace faceprobe::net {

std::optional<Window> face_window(const ByteImage& mask, int px) {
  constexpr double kMargin = 0.15;  // of the longer side, on each
  const std::optional<PixelBox> box = box_of(mask);
  if (!box) return std::nullopt;
  const double side = (1 + 2 * kMargin) * std::max(box->width(), box->height());
  return Window{(box->left + box->right - side) / 2, (box->top + box->bottom - side) / 2, px / side, px, px};
}

}  // namespace faceprobe::net

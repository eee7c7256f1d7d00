#pragma once
// The box of a mask: columns and rows that hold a pixel which is not zero.
//
//   if (const std::optional<PixelBox> box = box_of(mask)) use(box->right - box->left);

#include "faceprobe/core/image.h"

#include <algorithm>
#include <optional>

namespace faceprobe {

struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;  // pixels; [left, right) x [top, bottom)

  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

// `mask`: H x W x 1. Nothing where it is zero everywhere, or empty.
template <class T>
std::optional<PixelBox> box_of(const BasicImage<T>& mask) {
  PixelBox box{mask.width(), mask.height(), 0, 0};
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) == 0) continue;
      box.left = std::min(box.left, x);
      box.right = std::max(box.right, x + 1);
      box.top = std::min(box.top, y);
      box.bottom = std::max(box.bottom, y + 1);
    }
  }
  if (box.right <= box.left) return std::nullopt;
  return box;
}

}  // namespace faceprobe

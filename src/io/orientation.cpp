#include "io/orientation.h"

#include <utility>

namespace faceprobe::io {

Upright upright(int orientation, int stored_width, int stored_height) {
  const std::ptrdiff_t w = stored_width;
  const std::ptrdiff_t h = stored_height;
  switch (orientation) {
    case 2: return {stored_width, stored_height, w - 1, -1, w};        // mirrored left-right
    case 3: return {stored_width, stored_height, w * h - 1, -1, -w};   // turned by 180 degrees
    case 4: return {stored_width, stored_height, w * (h - 1), 1, -w};  // mirrored top-bottom
    case 5: return {stored_height, stored_width, 0, h, 1};             // transposed
    case 6: return {stored_height, stored_width, h - 1, h, -1};        // stored row 0 is the right side
    case 7: return {stored_height, stored_width, h * w - 1, -h, -1};   // transposed the other way
    case 8: return {stored_height, stored_width, h * (w - 1), -h, 1};  // stored row 0 is the left side
    default: return {stored_width, stored_height, 0, 1, w};
  }
}

}  // namespace faceprobe::io

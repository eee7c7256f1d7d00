#pragma once
// The eight EXIF orientations (EXIF 2.32, tag 0x0112) as one affine map from the stored pixel to its place upright.

#include <cstddef>

namespace faceprobe::io {

struct Upright {
  int width;  // of the upright picture
  int height;
  // Stored pixel (x, y) belongs at pixel number origin + x * step_x + y * step_y of the upright picture.
  std::ptrdiff_t origin;
  std::ptrdiff_t step_x;
  std::ptrdiff_t step_y;
};

// orientation outside 1..8 counts as 1.
Upright upright(int orientation, int stored_width, int stored_height);

// Copies `rows` stored rows, starting with row `first_row`, into the upright picture; `channels` values per pixel. The inner
// loop runs along the target's rows, so that a turned picture does not cost a cache miss per pixel.
template <class T>
void place_rows(const Upright& place, const T* stored, int stored_width, int first_row, int rows, int channels,
                T* target) {
  const bool along_x = place.step_x == 1 || place.step_x == -1;
  const int outer_count = along_x ? rows : stored_width;
  const int inner_count = along_x ? stored_width : rows;
  for (int outer = 0; outer < outer_count; ++outer) {
    for (int inner = 0; inner < inner_count; ++inner) {
      const std::ptrdiff_t x = along_x ? inner : outer;
      const std::ptrdiff_t y = along_x ? outer : inner;
      const T* from = stored + (y * stored_width + x) * channels;
      T* to = target + (place.origin + x * place.step_x + (first_row + y) * place.step_y) * channels;
      for (int c = 0; c < channels; ++c) to[c] = from[c];
    }
  }
}

}  // namespace faceprobe::io

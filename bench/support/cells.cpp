#include "support/cells.h"

#include "faceprobe/core/color.h"
#include "faceprobe/face/geometry.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {

void put_cell(const Image& picture, float gain, int cell_px, int x0, int y0, ByteImage& sheet) {
  face::Crop fit{.x_px = 0, .y_px = 0};
  fit.scale = static_cast<double>(cell_px) / std::max(picture.width(), picture.height());
  fit.width = std::min(cell_px, static_cast<int>(std::lround(fit.scale * picture.width())));
  fit.height = std::min(cell_px, static_cast<int>(std::lround(fit.scale * picture.height())));
  const ByteImage small = encode_srgb(face::crop_picture(picture, fit), gain);
  for (int y = 0; y < small.height(); ++y) {
    std::copy_n(small.pixel(0, y), small.row(y).size(),
                sheet.pixel(x0 + (cell_px - small.width()) / 2, y0 + (cell_px - small.height()) / 2 + y));
  }
}

}  // namespace faceprobe::bench

#include "insert_cycles/sheet.h"

#include "faceprobe/core/color.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {

namespace {

constexpr float kDifference = 10;

Image colours(const Image& picture) {
  Image out(picture.width(), picture.height(), 3);
  for (std::size_t i = 0; i < out.pixel_count(); ++i) std::copy_n(picture.data() + 4 * i, 3, out.data() + 3 * i);
  return out;
}

void paste(const ByteImage& tile, int x, int y, ByteImage& sheet) {
  for (int row = 0; row < tile.height(); ++row)
    std::copy_n(tile.pixel(0, row), 3 * static_cast<std::size_t>(tile.width()), sheet.pixel(x, y + row));
}

}  // namespace

void write_sheet(const std::filesystem::path& path, const std::vector<std::vector<Pair>>& rows) {
  const int width = rows.front().front().ours.width();
  const int height = rows.front().front().ours.height();
  ByteImage sheet(3 * width * static_cast<int>(rows.front().size()), height * static_cast<int>(rows.size()), 3);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t p = 0; p < rows[r].size(); ++p) {
      const Image ours = colours(rows[r][p].ours);
      const Image cycles = colours(rows[r][p].cycles);
      Image difference = ours;
      for (std::size_t i = 0; i < difference.values().size(); ++i)
        difference.values()[i] = kDifference * std::abs(ours.values()[i] - cycles.values()[i]);
      const float gain = exposure_for_quantile(cycles, 0.9F, 0.6F);
      const int x = 3 * width * static_cast<int>(p);
      const int y = height * static_cast<int>(r);
      paste(encode_srgb(ours, gain), x, y, sheet);
      paste(encode_srgb(cycles, gain), x + width, y, sheet);
      paste(encode_srgb(difference, gain), x + 2 * width, y, sheet);
    }
  }
  io::write_picture(path, sheet);
}

}  // namespace faceprobe::bench

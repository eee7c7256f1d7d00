#include "cycles/compare.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {

std::vector<int> eroded_pixels(const ByteImage& inside, int margin_px) {
  std::vector<int> out;
  for (int y = margin_px; y < inside.height() - margin_px; ++y) {
    for (int x = margin_px; x < inside.width() - margin_px; ++x) {
      bool all = true;
      for (int dy = -margin_px; dy <= margin_px && all; ++dy) {
        for (int dx = -margin_px; dx <= margin_px && all; ++dx) all = inside(x + dx, y + dy) != 0;
      }
      if (all) out.push_back(y * inside.width() + x);
    }
  }
  return out;
}

double relative_rmse(const Image& a, const Image& b, const std::vector<int>& pixels) {
  double difference = 0;
  double power = 0;
  for (const int pixel : pixels) {
    for (int c = 0; c < 3; ++c) {
      const double value_a = a(pixel % a.width(), pixel / a.width(), c);
      const double value_b = b(pixel % b.width(), pixel / b.width(), c);
      difference += (value_a - value_b) * (value_a - value_b);
      power += value_b * value_b;
    }
  }
  return std::sqrt(difference / power);
}

ByteImage difference_picture(const Image& a, const Image& b, const std::vector<int>& pixels, double full_scale) {
  double mean = 0;
  for (const int pixel : pixels) {
    for (int c = 0; c < 3; ++c) mean += b(pixel % b.width(), pixel / b.width(), c);
  }
  mean /= 3.0 * static_cast<double>(pixels.size());
  ByteImage out(a.width(), a.height(), 3, 128);
  for (const int pixel : pixels) {
    const int x = pixel % a.width();
    const int y = pixel / a.width();
    for (int c = 0; c < 3; ++c) {
      const double off = static_cast<double>(a(x, y, c) - b(x, y, c)) / (full_scale * mean);
      out(x, y, c) = static_cast<std::uint8_t>(std::clamp(std::lround(128.0 + 127.0 * off), 0L, 255L));
    }
  }
  return out;
}

}  // namespace faceprobe::bench

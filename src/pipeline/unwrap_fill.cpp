#include "pipeline/unwrap_fill.h"

#include <algorithm>
#include <vector>

namespace faceprobe::pipeline {
namespace {

// Colour times weight in the first channels, weight in the last.
Image halved(const Image& fine) {
  Image coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2, fine.channels());
  const int last = fine.channels() - 1;
  for (int y = 0; y < coarse.height(); ++y) {
    for (int x = 0; x < coarse.width(); ++x) {
      float* out = coarse.pixel(x, y);
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          if (2 * x + dx >= fine.width() || 2 * y + dy >= fine.height()) continue;
          const float* in = fine.pixel(2 * x + dx, 2 * y + dy);
          for (int c = 0; c <= last; ++c) out[c] += in[c];
        }
      }
      // Full from one known texel on: otherwise thin lines of known texels would be washed out.
      if (out[last] > 1.0F) {
        for (int c = 0; c < last; ++c) out[c] /= out[last];
        out[last] = 1.0F;
      }
    }
  }
  return coarse;
}

void add_from_below(const Image& coarse, Image& fine) {
  const int last = fine.channels() - 1;
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      float* out = fine.pixel(x, y);
      const float missing = 1.0F - out[last];
      if (missing <= 0.0F) continue;
      const float sx = std::clamp(0.5F * static_cast<float>(x) - 0.25F, 0.0F, static_cast<float>(coarse.width() - 1));
      const float sy = std::clamp(0.5F * static_cast<float>(y) - 0.25F, 0.0F, static_cast<float>(coarse.height() - 1));
      const int x0 = static_cast<int>(sx);
      const int y0 = static_cast<int>(sy);
      const int x1 = std::min(x0 + 1, coarse.width() - 1);
      const int y1 = std::min(y0 + 1, coarse.height() - 1);
      const float fx = sx - static_cast<float>(x0);
      const float fy = sy - static_cast<float>(y0);
      for (int c = 0; c <= last; ++c) {
        const float top = (1.0F - fx) * coarse(x0, y0, c) + fx * coarse(x1, y0, c);
        const float bottom = (1.0F - fx) * coarse(x0, y1, c) + fx * coarse(x1, y1, c);
        out[c] += missing * ((1.0F - fy) * top + fy * bottom);
      }
    }
  }
}

}  // namespace

Image push_pull(const Image& picture, const Image& weight) {
  const int channels = picture.channels();
  Image base(picture.width(), picture.height(), channels + 1);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float w = std::clamp(weight(x, y), 0.0F, 1.0F);
      for (int c = 0; c < channels; ++c) base(x, y, c) = w * picture(x, y, c);
      base(x, y, channels) = w;
    }
  }
  std::vector<Image> levels{std::move(base)};
  while (levels.back().width() > 1 || levels.back().height() > 1) levels.push_back(halved(levels.back()));
  for (std::size_t level = levels.size() - 1; level > 0; --level) add_from_below(levels[level], levels[level - 1]);

  Image out = picture;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float* in = levels.front().pixel(x, y);
      if (in[channels] <= 0.0F) continue;
      for (int c = 0; c < channels; ++c) out(x, y, c) = in[c] / in[channels];
    }
  }
  return out;
}

}  // namespace faceprobe::pipeline

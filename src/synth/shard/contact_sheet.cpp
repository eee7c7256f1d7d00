#include "faceprobe/synth/contact_sheet.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/core/region.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::synth {
namespace {

constexpr int kGapPx = 2;
constexpr std::uint8_t kGapGrey = 24;

void paste(const ByteImage& picture, int left, int top, ByteImage& sheet) {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) sheet(left + x, top + y, c) = picture(x, y, c);
    }
  }
}

std::uint8_t code(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

ByteImage encoded(const Image& linear, float scale) {
  ByteImage picture(linear.width(), linear.height(), 3);
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    picture.data()[i] = code(srgb_from_linear(std::clamp(scale * linear.data()[i], 0.0F, 1.0F)));
  }
  return picture;
}

// Puts the 98 % quantile at .8: one glint must not turn the rest black.
float fitting_scale(const Image& linear) {
  std::vector<float> values(linear.values().begin(), linear.values().end());
  const float bright = quantile_of(std::move(values), 0.98);
  return bright > 0 ? 0.8F / bright : 1.0F;
}

template <class Colour>
ByteImage painted(int width, int height, const Colour& colour) {
  ByteImage picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::array<std::uint8_t, 3> rgb = colour(x, y);
      for (int c = 0; c < 3; ++c) picture(x, y, c) = rgb[static_cast<std::size_t>(c)];
    }
  }
  return picture;
}

}  // namespace

ByteImage contact_sheet(std::span<const Sample> samples, int columns) {
  if (samples.empty() || columns < 1) return {};
  const int width = samples.front().photo.width();
  const int height = samples.front().photo.height();
  const int rows = (static_cast<int>(samples.size()) + columns - 1) / columns;
  ByteImage sheet(columns * (width + kGapPx) + kGapPx, rows * (height + kGapPx) + kGapPx, 3, kGapGrey);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int column = static_cast<int>(i) % columns;
    const int row = static_cast<int>(i) / columns;
    paste(samples[i].photo, kGapPx + column * (width + kGapPx), kGapPx + row * (height + kGapPx), sheet);
  }
  return sheet;
}

ByteImage layer_sheet(const Sample& sample, const ViewLayers& view) {
  const int width = sample.photo.width();
  const int height = sample.photo.height();
  float nearest = 0;
  float farthest = 0;
  for (const float depth : view.depth_m.values()) {
    if (depth <= 0) continue;
    nearest = nearest == 0 ? depth : std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const std::vector<ByteImage> pictures = {
      sample.photo,
      encoded(sample.highlight, fitting_scale(sample.highlight)),
      encoded(sample.diffuse, 1.0F),
      encoded(sample.albedo, 1.0F),
      encoded(sample.shading, fitting_scale(sample.shading)),
      painted(width, height,
              [&](int x, int y) {
                const float* n = view.normal.pixel(x, y);
                const bool there = n[0] != 0 || n[1] != 0 || n[2] != 0;
                return there ? std::array{code(0.5F + 0.5F * n[0]), code(0.5F + 0.5F * n[1]), code(0.5F + 0.5F * n[2])}
                             : std::array<std::uint8_t, 3>{0, 0, 0};
              }),
      painted(width, height,
              [&](int x, int y) {
                const float depth = view.depth_m(x, y);
                const std::uint8_t grey =
                    depth > 0 ? code(1.0F - 0.9F * (depth - nearest) / std::max(1e-6F, farthest - nearest))
                              : std::uint8_t{0};
                return std::array{grey, grey, grey};
              }),
      painted(width, height, [&](int x, int y) { return region_colour(static_cast<Region>(view.region(x, y))); }),
      painted(width, height,
              [&](int x, int y) {
                const std::uint8_t bits = sample.clip(x, y);
                return std::array{code((bits & 1U) != 0 ? 1.0F : 0.0F), code((bits & 2U) != 0 ? 1.0F : 0.0F),
                                  code((bits & 4U) != 0 ? 1.0F : 0.0F)};
              }),
  };
  ByteImage sheet(static_cast<int>(pictures.size()) * (width + kGapPx) + kGapPx, height + 2 * kGapPx, 3, kGapGrey);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    paste(pictures[i], kGapPx + static_cast<int>(i) * (width + kGapPx), kGapPx, sheet);
  return sheet;
}

}  // namespace faceprobe::synth

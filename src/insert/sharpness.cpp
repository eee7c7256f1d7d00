#include "faceprobe/core/quantile.h"
#include "faceprobe/insert/photo_look.h"
#include "insert/edge_tiles.h"
#include "insert/edge_width.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::insert {
namespace {

constexpr float kLeastGradient = 0.01F;  // of linear light, per pixel
constexpr float kOverTile = 5;           // an edge stands out by this from the tile's median gradient
constexpr float kOfStrongest = 0.3F;     // and is no weaker than this share of the tile's strongest
constexpr std::size_t kEnoughPixels = 8;
constexpr double kSharpest = 0.2;  // quantile of the tiles
constexpr double kLargestBlur = 5;
constexpr double kWide = 2.25;  // variance
constexpr int kClear = 6;       // no clipped pixel, and no end of the picture, this near

bool is_clear(const ByteImage& whole, int x, int y) {
  for (int j = y - kClear; j <= y + kClear; ++j) {
    for (int i = x - kClear; i <= x + kClear; ++i) {
      if (!whole(i, j)) return false;
    }
  }
  return true;
}

float threshold(const Image& size) {
  std::vector<float> inner;
  for (int y = kTileMargin; y < size.height() - kTileMargin; ++y) {
    inner.insert(inner.end(), size.pixel(kTileMargin, y), size.pixel(size.width() - kTileMargin, y));
  }
  const float strongest = *std::max_element(inner.begin(), inner.end());
  return std::max({kLeastGradient, kOverTile * upper_median_of(std::move(inner)), kOfStrongest * strongest});
}

// The median of the tile's edges.
std::optional<double> variance_of(const EdgeTile& tile) {
  const Gradients gradients = blurred_gradients(tile.luminance);
  const Image& size = gradients[1].size;
  const float least = threshold(size);
  std::vector<double> variances;
  for (int y = kTileMargin; y < size.height() - kTileMargin; ++y) {
    for (int x = kTileMargin; x < size.width() - kTileMargin; ++x) {
      if (size(x, y) < least) continue;
      const Step step = across_edge(gradients[1], x, y);
      if (size(x, y) < size(x + step.x, y + step.y) || size(x, y) < size(x - step.x, y - step.y)) continue;
      if (!is_clear(tile.whole, x, y)) continue;
      if (const auto variance = step_variance(gradients, x, y)) variances.push_back(*variance);
    }
  }
  if (variances.size() < kEnoughPixels) return std::nullopt;
  return quantile_of(std::move(variances), 0.5);
}

// Luminance at half the size; clipped, as 1, where any of the four pixels is.
Image half_size(const Image& linear) {
  Image half(linear.width() / 2, linear.height() / 2, 1);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      const std::array<float, 4> four = {
          whole_luminance(linear, 2 * x, 2 * y), whole_luminance(linear, 2 * x + 1, 2 * y),
          whole_luminance(linear, 2 * x, 2 * y + 1), whole_luminance(linear, 2 * x + 1, 2 * y + 1)};
      const bool clipped = *std::max_element(four.begin(), four.end()) >= 1;
      half(x, y) = clipped ? 1.0F : (four[0] + four[1] + four[2] + four[3]) / 4;
    }
  }
  return half;
}

// Wide edges are measured on a smaller picture: there they are as narrow as others, and noise is less.
std::optional<double> variance_of_picture(const Image& linear) {
  std::vector<double> variances;
  for (const EdgeTile& tile : strongest_edges(linear)) {
    if (const auto variance = variance_of(tile)) variances.push_back(*variance);
  }
  std::optional<double> found;
  if (!variances.empty()) found = quantile_of(std::move(variances), kSharpest);
  if (std::min(linear.width(), linear.height()) < 2 * kTileSide || (found && *found < kWide)) return found;
  const std::optional<double> half = variance_of_picture(half_size(linear));
  constexpr double kTwoPixels = 0.25;  // variance of the mean of two
  return half && *half > 0 ? std::max(0.0, 4 * *half - kTwoPixels) : found;
}

}  // namespace

float estimate_blur_px(const Image& linear) {
  if (linear.channels() != 1 && linear.channels() != 3) {
    throw std::invalid_argument("estimate_blur_px: the picture must have one or three channels");
  }
  const std::optional<double> variance = variance_of_picture(linear);
  return variance ? static_cast<float>(std::clamp(std::sqrt(std::max(0.0, *variance)), 0.0, kLargestBlur))
                  : kUnknownBlurPx;
}

}  // namespace faceprobe::insert

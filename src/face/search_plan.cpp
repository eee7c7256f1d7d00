#include "face/search_plan.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::face {
namespace {

// Measured with the full-range detector on 28 shrunken portraits: all found at a sixteenth of the square, 24 at a 24th.
constexpr float kSmallestFace = 1.0F / 16;
constexpr float kOverlap = 0.25F;
constexpr float kScaleRatio = kOverlap / kSmallestFace;

// Starts of intervals of length `side` that cover [0, length], evenly spread.
std::vector<float> starts(float length, float side) {
  if (side >= length) return {0.5F * (length - side)};
  const int count = 1 + static_cast<int>(std::ceil((length - side) / (side * (1 - kOverlap)) - 1e-4F));
  std::vector<float> at;
  at.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) at.push_back((length - side) * static_cast<float>(i) / static_cast<float>(count - 1));
  return at;
}

}  // namespace

SquareRegion whole_square(int width, int height, float padding) {
  return {{0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height)},
          padding * static_cast<float>(std::max(width, height)),
          0};
}

std::vector<SquareRegion> tile_squares(int width, int height, float side) {
  std::vector<SquareRegion> tiles;
  for (const float y : starts(static_cast<float>(height), side)) {
    for (const float x : starts(static_cast<float>(width), side)) {
      tiles.push_back({{x + 0.5F * side, y + 0.5F * side}, side, 0});
    }
  }
  return tiles;
}

std::vector<SquareRegion> plan_tiles(int width, int height, float face_px, int max_tiles) {
  const auto whole = static_cast<float>(std::max(width, height));
  for (float smallest = std::max(face_px, 1.0F); whole * kSmallestFace > smallest; smallest *= 1.1F) {
    const float ratio = whole * kSmallestFace / smallest;
    const int levels = std::max(1, static_cast<int>(std::ceil(std::log(ratio) / std::log(kScaleRatio) - 1e-4F)));
    std::vector<SquareRegion> tiles;
    for (int level = 1; level <= levels && static_cast<int>(tiles.size()) <= max_tiles; ++level) {
      const float side = whole * std::pow(ratio, -static_cast<float>(level) / static_cast<float>(levels));
      const std::vector<SquareRegion> more = tile_squares(width, height, side);
      tiles.insert(tiles.end(), more.begin(), more.end());
    }
    if (static_cast<int>(tiles.size()) <= max_tiles) return tiles;
  }
  return {};
}

}  // namespace faceprobe::face

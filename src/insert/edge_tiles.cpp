#include "insert/edge_tiles.h"

#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace faceprobe::insert {
namespace {

constexpr std::size_t kMostTiles = 48;
constexpr float kWhiteLight = 0.98F;  // light of code 253
constexpr int kRowStep = 4, kColumnStep = 2;

struct Candidate {
  int left = 0, top = 0;
  float strength = 0;
};

float light(const Image& linear, int x, int y) {
  const float* value = linear.pixel(x, y);
  return linear.channels() == 3 ? luminance(value) : value[0];
}

bool pixel_is_whole(const Image& linear, int x, int y) {
  const float* value = linear.pixel(x, y);
  return std::all_of(value, value + linear.channels(),
                     [](float v) { return v < kWhiteLight && v > -kWhiteLight; });  // NaN is not
}

// The largest difference across two pixels, on a sparse grid: an edge crosses many of its lines.
float strongest_difference(const Image& linear, int left, int top) {
  const int right = std::min(left + kTileSide, linear.width() - 1);
  const int bottom = std::min(top + kTileSide, linear.height() - 1);
  float most = 0;
  for (int y = std::max(top, 1); y < bottom; y += kRowStep) {
    for (int x = std::max(left, 1); x < right; x += kColumnStep) {
      const float across = light(linear, x + 1, y) - light(linear, x - 1, y);
      const float down = light(linear, x, y + 1) - light(linear, x, y - 1);
      const float square = across * across + down * down;
      if (!(square > most)) continue;
      if (pixel_is_whole(linear, x + 1, y) && pixel_is_whole(linear, x - 1, y) && pixel_is_whole(linear, x, y + 1) &&
          pixel_is_whole(linear, x, y - 1)) {
        most = square;
      }
    }
  }
  return most;
}

EdgeTile cut(const Image& linear, const Candidate& from) {
  constexpr int kSide = kTileSide + 2 * kTileMargin;
  EdgeTile tile{Image(kSide, kSide, 1), ByteImage(kSide, kSide, 1)};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int from_x = from.left - kTileMargin + x;
      const int from_y = from.top - kTileMargin + y;
      const int inner_x = std::clamp(from_x, 0, linear.width() - 1);
      const int inner_y = std::clamp(from_y, 0, linear.height() - 1);
      tile.luminance(x, y) = whole_luminance(linear, inner_x, inner_y);
      tile.whole(x, y) = inner_x == from_x && inner_y == from_y && tile.luminance(x, y) < 1;
    }
  }
  return tile;
}

}  // namespace

float whole_luminance(const Image& linear, int x, int y) {
  return pixel_is_whole(linear, x, y) ? light(linear, x, y) : 1.0F;
}

std::vector<EdgeTile> strongest_edges(const Image& linear) {
  std::vector<Candidate> candidates;
  for (int top = 0; top < linear.height(); top += kTileSide) {
    for (int left = 0; left < linear.width(); left += kTileSide) {
      const float strength = strongest_difference(linear, left, top);
      if (strength > 0) candidates.push_back({left, top, strength});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  if (candidates.size() > kMostTiles) candidates.resize(kMostTiles);
  std::vector<EdgeTile> tiles;
  tiles.reserve(candidates.size());
  for (const Candidate& candidate : candidates) tiles.push_back(cut(linear, candidate));
  return tiles;
}

}  // namespace faceprobe::insert

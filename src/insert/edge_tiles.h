#pragma once
// Where in a photo its strongest edges are: square tiles of luminance, a few dozen, however large the photo is.
//
//   for (const EdgeTile& tile : strongest_edges(photo)) ...

#include "faceprobe/core/image.h"

#include <vector>

namespace faceprobe::insert {

inline constexpr int kTileSide = 64;
inline constexpr int kTileMargin = 16;

struct EdgeTile {
  Image luminance;  // the tile with its margin on all sides, as the picture's nearest pixel outside it
  ByteImage whole;  // 1 inside the picture where no channel was clipped
};

// Those with the strongest edge first. Pictures smaller than a tile make one.
std::vector<EdgeTile> strongest_edges(const Image& linear);

// Luminance; 1 where a channel is clipped or not a number.
float whole_luminance(const Image& linear, int x, int y);

}  // namespace faceprobe::insert

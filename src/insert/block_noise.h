#pragma once
// What is left of small blocks of a photo, in encoded light, when slow shading is taken out of each: the grain, and any texture.
//
//   for (const BlockNoise& block : measure_blocks(photo, fit)) ...     // at most a few thousand, spread over the photo

#include "faceprobe/core/image.h"
#include "insert/block_fit.h"

#include <vector>

namespace faceprobe::insert {

struct BlockNoise {
  double brightness = 0;  // encoded, mean of the channels
  Moments shared;         // of the mean of the channels
  Moments colour;         // of the channels' differences from their mean, averaged over the channels
};

// Blocks with clipped values in them are left out. One or three channels.
std::vector<BlockNoise> measure_blocks(const Image& linear, const BlockFit& fit);

}  // namespace faceprobe::insert

#pragma once
// Which squares of a photo the detectors look at, so that faces of a wanted width are found at a bounded cost.

#include "face/sampler.h"

#include <vector>

namespace faceprobe::face {

// The square around the whole photo, `padding` times as large as the photo's long side.
SquareRegion whole_square(int width, int height, float padding);

// Overlapping squares of the given side that cover the photo. Any object no wider than a quarter of the side lies whole
// in one of them.
std::vector<SquareRegion> tile_squares(int width, int height, float side);

// Tiles at as many scales as it takes to see faces from `face_px` wide, given that one look sees those between a
// sixteenth and a quarter of its square, and that the whole photo has been looked at. When that needs more than
// `max_tiles`, the finest scale is made coarser until it fits.
std::vector<SquareRegion> plan_tiles(int width, int height, float face_px, int max_tiles);

}  // namespace faceprobe::face

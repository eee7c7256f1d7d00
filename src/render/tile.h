#pragma once
// A small square of the picture, sampled until it is quiet enough.

#include "faceprobe/render/path_tracer.h"
#include "render/path.h"

namespace faceprobe::render {

inline constexpr int kTilePx = 16;

// Fills the tile's pixels of `out`.
void render_tile(const PathScene& scene, const RenderOptions& options, int tile_x, int tile_y, Layers& out);

}  // namespace faceprobe::render

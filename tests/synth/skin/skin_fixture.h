#pragma once
// Small textures and sets of points to evaluate skin at.

#include "faceprobe/synth/skin.h"

namespace faceprobe::synth::testing {

// Uniform sRGB colour.
ByteImage plain_texture(int size_px, std::array<std::uint8_t, 3> colour);
// Skin-like colour with smooth variation and a dark and a red patch.
ByteImage varied_texture(int size_px);

// The centres of all texels of a square texture, row by row, on a flat patch of a face; all cheeks.
SkinPoints texel_points(int size_px);
// Points scattered through a box about the head, without UVs.
SkinPoints scattered_points(int count, std::uint64_t seed);

}  // namespace faceprobe::synth::testing

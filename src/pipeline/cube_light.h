#pragma once
// A light as the cube maps that real-time renderers reflect: six faces, each coarser level blurred for a rougher surface, and the pixels in
// which EXT_lights_image_based wants them.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <array>

namespace faceprobe::pipeline {

// +x, -x, +y, -y, +z, -z of the cube map, see cube_direction(). Three channels, linear.
using CubeFaces = std::array<Image, 6>;

// Where the centre of a texel of a stored face looks in glTF's axes, of any length. `column` and `row` of `size`, row 0 first in the file.
// Cube maps are left-handed, glTF is not: as everywhere the map's x is turned round, so that face +x holds what is at -x. And the extension has its
// images upside down. Both as Babylon.js reads them (docs/recipes.md).
Eigen::Vector3d cube_direction(int face, int column, int row, int size);

// The map as it is.
CubeFaces sharp_cube(const EnvMap& map, int size);
// What a GGX surface of a glTF roughness in (0, 1] mirrors, looked at along its normal: the mean of the light under D(H) (N.L), which for
// V = N depends on the angle between N and L alone. Summed over all `cells` (#cells of `grid` x 3), so nothing is random.
CubeFaces rough_cube(const Eigen::MatrixX3f& cells, const SphereGrid& grid, double roughness, int size);

inline constexpr float kLargestRgbd = 255;
// RGBD: colour = (rgb / 255)^2.2 / (a / 255), up to kLargestRgbd; brighter is cut off, negative is 0.
ByteImage encode_rgbd(const Image& face);

}  // namespace faceprobe::pipeline

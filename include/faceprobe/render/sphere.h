#pragma once
// What a ball in the place of the face would look like: the plainest proof of an estimated light, and the picture that relighting
// errors are measured on. Orthographic camera on the +z axis, as if the ball stood where the face was.
//
//   Image ball = render_sphere(light.radiance, SphereGrid(16), {.material = SphereMaterial::kMirror, .size_px = 160});
//
// Direct light only, no ground, no shadows.

#include "faceprobe/core/image.h"
#include "faceprobe/core/sphere_grid.h"

#include <string>

namespace faceprobe::render {

enum class SphereMaterial {
  kDiffuse,  // Lambert, albedo 1
  kMatte,    // rough metal, Beckmann m = .3
  kMirror,   // ideal mirror
};

struct SphereOptions {
  SphereMaterial material = SphereMaterial::kDiffuse;
  int size_px = 128;  // width and height of the picture; the ball touches its edges
  int threads = 0;

  std::string validate() const;
};

// size x size x 4: linear colour and coverage (1 inside the ball, fractions on its rim). `radiance`: #cells x 3.
// Throws std::invalid_argument for options that do not validate and another number of cells.
Image render_sphere(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const SphereOptions& options = {});

}  // namespace faceprobe::render

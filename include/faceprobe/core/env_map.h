#pragma once
// A lat-long environment map: the radiance that arrives from every direction, linear Rec.709, relative scale.
//
// Layout: 2N x N texels, row 0 = up, texel centres at ((x + .5) / W, (y + .5) / H). The frame is the camera's (CONVENTIONS.md):
// +x right in the photo, +y up, +z towards the viewer. Centre column = +z, u = .25 is +x. This is OpenEXR's lat-long frame;
// other tools differ by a whole-column roll, never by a flip (see `Orientation`).
//
//   EnvMap map(256, 128);
//   map.radiance()(64, 64, 0) = 10;                         // a red light at camera right
//   Eigen::Vector3f red = map.sample({1, 0, 0});            // finds it again
//
// Not for solving: texels shrink towards the poles. Solvers use core/sphere_grid.h.

#include "faceprobe/core/image.h"

#include <Eigen/Core>

namespace faceprobe {

// Point on the map: u in [0, 1) from left to right, v in [0, 1] from the top. Both functions are inverses of one another.
Eigen::Vector3f direction_from_uv(const Eigen::Vector2f& uv);
Eigen::Vector2f uv_from_direction(const Eigen::Vector3f& direction);  // direction need not be of unit length
// Solid angle per unit of u and v at height v, in steradians: |d(direction)/d(u,v)| = 2 pi^2 sin(pi v).
float solid_angle_density(float v);
// Exact solid angle of one texel in row y of a map with the given size; all texels together give 4 pi.
double texel_solid_angle(int y, int width, int height);

// Whose convention the columns of a written map follow. The numbers are rolls to the right, in quarters of the width.
enum class Orientation {
  kOpenExr = 0,  // also USD, Mitsuba, Filament: centre = +z
  kThree = 1,    // three.js and Blender: centre = +x in their frame; a roll by W/4
  kDebevec = 2,  // USC light probes: centre = -z; a roll by W/2
};

class EnvMap {
 public:
  // No map yet: 0 x 0 texels.
  EnvMap() = default;
  // Black map. Throws std::invalid_argument unless width = 2 * height > 0.
  EnvMap(int width, int height);
  // Takes three-channel radiance of size 2N x N; throws std::invalid_argument otherwise.
  explicit EnvMap(Image radiance);

  int width() const { return radiance_.width(); }
  int height() const { return radiance_.height(); }
  // Height x width x 3, linear Rec.709, row 0 up. Its size stays as it is.
  Image& radiance() { return radiance_; }
  const Image& radiance() const { return radiance_; }

  // Unit vector through the centre of a texel.
  Eigen::Vector3f direction(int x, int y) const;
  // Bilinear look-up in a direction of any length; wraps in u, continues over the poles in v. Not for a map of no texels.
  Eigen::Vector3f sample(const Eigen::Vector3f& direction) const;
  // Radiance integrated over the sphere, per channel (radiance x steradian).
  Eigen::Vector3d integral() const;

 private:
  Image radiance_;
};

// The map as seen from a frame turned by `target_from_source`: a light at d in `map` is at R d in the result. Same size.
// R is a rotation.
EnvMap rotate(const EnvMap& map, const Eigen::Matrix3f& target_from_source);
// Another size, area-averaged by solid angle when smaller, bilinear when larger. Keeps the integral to the filter's accuracy.
// Throws std::invalid_argument unless width = 2 * height > 0.
EnvMap resize(const EnvMap& map, int width, int height);
// Columns rolled from the native frame into another tool's, and back. For kThree the width is a multiple of 4: rolls are of whole columns.
EnvMap to_orientation(const EnvMap& map, Orientation orientation);
EnvMap from_orientation(const EnvMap& map, Orientation orientation);

}  // namespace faceprobe

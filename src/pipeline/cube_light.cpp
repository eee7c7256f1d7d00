#include "pipeline/cube_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace faceprobe::pipeline {
namespace {

constexpr double kRgbdGamma = 2.2;

CubeFaces make_faces(int size) {
  CubeFaces faces;
  faces.fill(Image(size, size, 3));
  return faces;
}

// Calls colour_of(direction) for each texel.
template <class Colour>
CubeFaces draw_faces(int size, const Colour& colour_of) {
  CubeFaces faces = make_faces(size);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Eigen::Vector3f colour = colour_of(cube_direction(face, x, y, size).normalized().cast<float>());
        std::copy_n(colour.data(), 3, faces[static_cast<std::size_t>(face)].pixel(x, y));
      }
    }
  }
  return faces;
}

}  // namespace

Eigen::Vector3d cube_direction(int face, int column, int row, int size) {
  const double s = 2 * (column + 0.5) / size - 1;
  const double t = 1 - 2 * (row + 0.5) / size;
  // OpenGL's table of faces, x negated.
  switch (face) {
    case 0: return {-1, -t, -s};
    case 1: return {1, -t, s};
    case 2: return {-s, 1, t};
    case 3: return {-s, -1, -t};
    case 4: return {-s, -t, 1};
    case 5: return {s, -t, -1};
    default: throw std::invalid_argument("A cube has faces 0 to 5.");
  }
}

CubeFaces sharp_cube(const EnvMap& map, int size) {
  return draw_faces(size, [&map](const Eigen::Vector3f& direction) { return map.sample(direction); });
}

CubeFaces rough_cube(const Eigen::MatrixX3f& cells, const SphereGrid& grid, double roughness, int size) {
  if (cells.rows() != grid.cell_count() || !(roughness > 0 && roughness <= 1))
    throw std::invalid_argument("A rough cube needs one radiance per cell, and a roughness in (0, 1].");
  const auto alpha2 = static_cast<float>(std::pow(roughness, 4));  // glTF: alpha = roughness^2
  return draw_faces(size, [&](const Eigen::Vector3f& normal) -> Eigen::Vector3f {
    const Eigen::ArrayXf cosine = (grid.directions() * normal).array();
    // cos^2 of the angle to the half vector is (1 + cosine) / 2; constant factors of D cancel in the mean.
    const Eigen::ArrayXf spread = 1 + (alpha2 - 1) * 0.5F * (1 + cosine);
    const Eigen::VectorXf weight = (cosine.max(0.0F) / spread.square()).matrix();
    return cells.transpose() * weight / weight.sum();
  });
}

ByteImage encode_rgbd(const Image& face) {
  ByteImage out(face.width(), face.height(), 4);
  for (int y = 0; y < face.height(); ++y) {
    for (int x = 0; x < face.width(); ++x) {
      const float* p = face.pixel(x, y);
      const float brightest = std::max({p[0], p[1], p[2], 1.0F});
      const float divisor = std::clamp(std::floor(kLargestRgbd / brightest), 1.0F, 255.0F);
      for (int c = 0; c < 3; ++c) {
        const double share = std::clamp(static_cast<double>(p[c] * divisor / 255), 0.0, 1.0);
        out(x, y, c) = static_cast<std::uint8_t>(std::lround(255 * std::pow(share, 1 / kRgbdGamma)));
      }
      out(x, y, 3) = static_cast<std::uint8_t>(divisor);
    }
  }
  return out;
}

}  // namespace faceprobe::pipeline

#pragma once
// A stand-in for a face with everything known: an ellipsoid's normals as a camera sees them, lit exactly by the transport model.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/transport.h"

#include <cmath>
#include <random>
#include <vector>

namespace faceprobe::lighting::testing {

// Patches at equal steps in the picture over an ellipsoid, 75 x 100 x 80 mm half axes: about a face's. View along the axis.
inline Observations ellipsoid_face(int across = 40) {
  std::vector<Eigen::RowVector3f> normals;
  for (int row = 0; row < across; ++row) {
    for (int column = 0; column < across; ++column) {
      const double x = 2.0 * (column + 0.5) / across - 1;
      const double y = 2.0 * (row + 0.5) / across - 1;
      if (x * x + y * y > 0.95) continue;
      const double z = std::sqrt(1 - x * x - y * y);
      normals.push_back(Eigen::RowVector3d(x / 0.75, y / 1.0, z / 0.8).normalized().cast<float>());
    }
  }
  Observations face;
  face.resize(static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) face.normal.row(static_cast<Eigen::Index>(i)) = normals[i];
  face.view.rowwise() = Eigen::RowVector3f(0, 0, 1);
  return face;
}

// Fills highlight and shading for a light given per cell; noise is a relative standard deviation.
inline void light_up(Observations& face, const SphereGrid& grid, const Eigen::MatrixX3f& radiance, float noise = 0,
                     unsigned seed = 1) {
  const Transport transport = build_transport(face, grid);
  face.highlight = transport.highlight() * radiance;
  face.shading = transport.diffuse() * radiance;
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0.0F, noise);
  if (noise <= 0) return;
  for (Eigen::Index i = 0; i < face.count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      face.highlight(i, c) = std::max(0.0F, face.highlight(i, c) * (1 + normal(random)));
      face.shading(i, c) = std::max(0.0F, face.shading(i, c) * (1 + normal(random)));
    }
  }
}

// A disc of light of the given radius on a dim surround; irradiance of the disc is 1, of the surround `ambient` times pi.
inline Eigen::MatrixX3f lamp(const SphereGrid& grid, const Eigen::Vector3d& direction, double radius_deg, float ambient,
                             const Eigen::RowVector3f& colour = {1, 1, 1}) {
  Eigen::MatrixX3f radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, ambient);
  std::vector<int> inside;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (angle_between_deg(grid.direction(j).cast<double>(), direction) <= radius_deg) inside.push_back(j);
  }
  if (inside.empty()) inside.push_back(grid.cell_of(direction.cast<float>()));
  const float each = 1.0F / static_cast<float>(static_cast<double>(inside.size()) * grid.cell_solid_angle());
  for (const int j : inside) radiance.row(j) += each * colour;
  return radiance;
}

inline Eigen::Vector3d brightest_direction(const Eigen::MatrixX3f& radiance, const SphereGrid& grid) {
  Eigen::Index best = 0;
  radiance.rowwise().sum().maxCoeff(&best);
  return grid.direction(static_cast<int>(best)).cast<double>();
}

}  // namespace faceprobe::lighting::testing

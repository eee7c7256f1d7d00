#include "faceprobe/core/sphere_grid.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe {

Eigen::MatrixX3f grid_from_env_map(const EnvMap& map, const SphereGrid& grid) {
  // Every texel gives its energy to the cell that holds it; coarse texels are split first, so that a cell's
  // share is right to a few percent however the texels fall.
  const double texel = std::sqrt(texel_solid_angle(map.height() / 2, map.width(), map.height()));
  const int split = std::max(1, static_cast<int>(std::ceil(8.0 * texel / std::sqrt(grid.cell_solid_angle()))));
  Eigen::MatrixX3d energy = Eigen::MatrixX3d::Zero(grid.cell_count(), 3);
  for (int y = 0; y < map.height() * split; ++y) {
    const double solid_angle = texel_solid_angle(y, map.width() * split, map.height() * split);
    for (int x = 0; x < map.width() * split; ++x) {
      const Eigen::Vector3f d =
          direction_from_uv({(static_cast<float>(x) + 0.5F) / static_cast<float>(map.width() * split),
                             (static_cast<float>(y) + 0.5F) / static_cast<float>(map.height() * split)});
      const int cell = grid.cell_of(d);
      const Eigen::Map<const Eigen::RowVector3f> radiance(map.radiance().pixel(x / split, y / split));
      energy.row(cell) += solid_angle * radiance.cast<double>();
    }
  }
  // Dividing by the nominal area, not by the area that happened to fall in, is what keeps the integral.
  return (energy / grid.cell_solid_angle()).cast<float>();
}

EnvMap env_map_from_grid(const Eigen::MatrixX3f& cells, const SphereGrid& grid, int width, int height) {
  if (cells.rows() != grid.cell_count() || width < 1 || height < 1)
    throw std::invalid_argument("A map is made of a row for every cell, and has a size.");
  // Texels wider than half a cell would miss cells between them: such maps are drawn finer and averaged.
  if (width < 8 * grid.nside()) {
    const int finer = (8 * grid.nside() + width - 1) / width;
    return resize(env_map_from_grid(cells, grid, finer * width, finer * height), width, height);
  }
  EnvMap map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SphereGrid::Interpolation at = grid.interpolate(map.direction(x, y));
      Eigen::RowVector3f value = Eigen::RowVector3f::Zero();
      for (std::size_t i = 0; i < 4; ++i) value += at.weight[i] * cells.row(at.cell[i]);
      Eigen::Map<Eigen::RowVector3f>(map.radiance().pixel(x, y)) = value;
    }
  }
  const Eigen::Vector3d wanted = cells.cast<double>().colwise().sum().transpose() * grid.cell_solid_angle();
  const Eigen::Vector3d found = map.integral();
  Eigen::Array3f gain = Eigen::Array3f::Ones();
  for (int c = 0; c < 3; ++c) {
    if (found[c] > 0.0) gain[c] = static_cast<float>(wanted[c] / found[c]);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) Eigen::Map<Eigen::Array3f>(map.radiance().pixel(x, y)) *= gain;
  }
  return map;
}

Eigen::MatrixX3f grid_from_grid(const Eigen::MatrixX3f& cells, const SphereGrid& from, const SphereGrid& to) {
  if (cells.rows() != from.cell_count()) throw std::invalid_argument("A grid's light needs one row a cell.");
  const double spacing = std::sqrt(std::max(from.cell_solid_angle(), to.cell_solid_angle()));
  const auto width = static_cast<float>(0.5 * spacing);
  const auto least_cosine = static_cast<float>(std::cos(std::min(kPi, 2.5 * spacing)));
  Eigen::MatrixX3f out = Eigen::MatrixX3f::Zero(to.cell_count(), 3);
  for (int i = 0; i < to.cell_count(); ++i) {
    const Eigen::RowVector3f centre = to.directions().row(i);
    float sum = 0;
    for (int j = 0; j < from.cell_count(); ++j) {
      const float cosine = from.directions().row(j).dot(centre);
      if (cosine < least_cosine) continue;
      const float angle = std::acos(std::min(1.0F, cosine)) / width;
      const float weight = std::exp(-0.5F * angle * angle);
      out.row(i) += weight * cells.row(j);
      sum += weight;
    }
    out.row(i) /= sum;
  }
  return out;
}

}  // namespace faceprobe

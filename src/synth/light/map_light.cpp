#include "faceprobe/synth/map_light.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "synth/light/cell_lattice.h"
#include "synth/light/find_lights.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

void check(const std::string& name, const EnvMap& map) {
  const auto refuse = [&name](const std::string& found) {
    throw Error(ExitCode::kInput,
                "The environment map " + name + " " + found +
                    "; radiance is finite, not negative and somewhere above zero. Mend the map or leave it out.");
  };
  if (map.radiance().empty()) refuse("has no texels");
  float most = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < 3 * map.width(); ++x) {
      const float value = map.radiance().row(y)[static_cast<std::size_t>(x)];
      if (std::isfinite(value) && value >= 0) {
        most = std::max(most, value);
        continue;
      }
      refuse("holds " +
             std::string(std::isnan(value)   ? "NaN"
                         : std::isinf(value) ? "infinity"
                                             : "a negative value") +
             " at column " + std::to_string(x / 3) + ", row " + std::to_string(y));
    }
  }
  if (!(most > 0)) refuse("is black");
}

// Mean radiance of cells that hold these sums of radiance x solid angle, scaled so that rounding takes nothing off the whole.
Eigen::MatrixX3f means(const CellSums& sums, const Eigen::Vector3d& whole) {
  Eigen::MatrixX3f cells(static_cast<Eigen::Index>(sums.size()), 3);
  const double solid_angle = 4.0 * kPi / static_cast<double>(sums.size());
  for (int c = 0; c < 3; ++c) {
    double found = 0;
    for (const Eigen::Vector4f& sum : sums) found += static_cast<double>(sum(c));
    const auto factor = static_cast<float>((found > 0 ? whole(c) / found : 0.0) / solid_angle);
    for (std::size_t i = 0; i < sums.size(); ++i) cells(static_cast<Eigen::Index>(i), c) = factor * sums[i](c);
  }
  return cells;
}

// Not core's grid_from_env_map: this takes a tenth of its time, which counts for a hundred maps, and texels that are shared
// between cells do not move to the middle of one.
Eigen::MatrixX3f cells_of(const EnvMap& map, int nside) {
  // At least four points to a cell along each axis; fewer would favour some cells over others.
  const double cell = std::sqrt(4.0 * kPi / (12.0 * nside * nside));
  const int split = static_cast<int>(std::ceil(4.0 * kPi / map.height() / cell));
  const int columns = split * map.width();
  const int rows = split * map.height();
  const CellLattice lattice(nside);
  CellSums sums = lattice.zero();
  Eigen::MatrixX3f directions(columns, 3);
  Eigen::MatrixX3f values(columns, 3);
  Eigen::MatrixX2f around(columns, 2);
  for (int x = 0; x < columns; ++x) {
    const Eigen::Vector3f d = direction_from_uv({(static_cast<float>(x) + 0.5F) / static_cast<float>(columns), 0.5F});
    around.row(x) << d.x(), d.z();
  }
  for (int y = 0; y < rows; ++y) {
    const double theta = kPi * (y + 0.5) / rows;
    directions.col(0) = around.col(0) * static_cast<float>(std::sin(theta));
    directions.col(1).setConstant(static_cast<float>(std::cos(theta)));
    directions.col(2) = around.col(1) * static_cast<float>(std::sin(theta));
    const auto solid_angle = static_cast<float>(texel_solid_angle(y, columns, rows));
    for (int x = 0; x < columns; ++x) {
      for (int c = 0; c < 3; ++c) values(x, c) = solid_angle * map.radiance()(x / split, y / split, c);
    }
    lattice.add(directions, Eigen::Matrix3f::Identity(), values, sums);
  }
  return means(sums, map.integral());
}

}  // namespace

std::string MapOptions::validate() const {
  if (max_distant < 0 || max_distant > 64) return "The number of distant lights must be 0 to 64.";
  if (!(max_light_radius > 0 && max_light_radius <= 0.2F))
    return "The radius of a distant light must be up to 0.2 radians.";
  if (nside < 4 || nside > 128) return "The stored cells of a map must have nside 4 to 128.";
  return {};
}

MapLight prepare_map(const std::string& name, const EnvMap& map, const MapOptions& options) {
  const std::string wrong = options.validate();
  if (!wrong.empty()) throw std::invalid_argument(wrong);
  check(name, map);
  MapLight light;
  light.name = name;
  light.radiance = map;
  light.nside = options.nside;
  light.mean_radiance = (map.integral() / (4.0 * kPi)).cast<float>();
  const FoundLights found = find_lights(map, options.max_distant, options.max_light_radius);
  light.distant = found.lights;
  light.directions = SphereGrid(options.nside).directions();
  light.cells = cells_of(found.rest, options.nside);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Map<const Eigen::Vector3f> whole(map.radiance().pixel(x, y));
      const Eigen::Map<const Eigen::Vector3f> rest(found.rest.radiance().pixel(x, y));
      if (whole != rest) light.covered.push_back({x, y, rest});
    }
  }
  return light;
}

LightSample light_from_map(const MapLight& map, const Eigen::Matrix3f& scene_from_map, const Eigen::Vector3f& gain,
                           const SphereGrid& grid) {
  const CellLattice lattice(grid.nside());
  CellSums sums = lattice.zero();
  lattice.add(map.directions, scene_from_map, map.cells, sums);
  LightSample sample;
  sample.cells.resize(grid.cell_count(), 3);
  // From sums of source cells' radiance to means of the target's.
  const auto smaller = static_cast<float>(grid.cell_count()) / static_cast<float>(map.cells.rows());
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sample.cells(static_cast<Eigen::Index>(i), c) = gain(c) * smaller * sums[i](c);
    }
  }
  for (const DistantLight& light : map.distant) {
    sample.distant.push_back({scene_from_map * light.direction, light.irradiance.cwiseProduct(gain)});
  }
  return sample;
}

}  // namespace faceprobe::synth

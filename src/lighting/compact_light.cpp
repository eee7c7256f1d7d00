#include "faceprobe/lighting/compact_light.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

namespace faceprobe::lighting {

namespace {

constexpr int kCellParts = 37;      // of a disc of 20 degrees: closer together than the cells of the solvers' grid
constexpr double kPartsATexel = 4;  // so that a disc of many texels is even
constexpr int kMostParts = 4096;    // of a disc on a large map
constexpr double kNearestLightDeg = 15;

}  // namespace

double solid_angle_sr(const CompactLight& light) { return 2 * kPi * (1 - std::cos(radians(light.width_deg / 2))); }

Eigen::MatrixX3f disc_directions(const Eigen::Vector3d& centre, double width_deg, int count) {
  if (!(width_deg > 0 && width_deg <= 180)) throw std::invalid_argument("A disc's width lies in (0, 180] degrees.");
  if (count < 1) throw std::invalid_argument("A disc needs a direction at least.");
  // Vogel's sunflower: equal areas, turned by the golden angle from one to the next.
  constexpr double kGoldenAngle = 2 * kPi * (2 - std::numbers::phi);
  const Eigen::Vector3d towards = centre.normalized();
  const Eigen::Vector3d u = towards.unitOrthogonal();
  const Eigen::Vector3d v = towards.cross(u);
  const double depth = 1 - std::cos(radians(width_deg / 2));
  Eigen::MatrixX3f directions(count, 3);
  for (int i = 0; i < count; ++i) {
    const double cosine = count == 1 ? 1 : 1 - depth * (i + 0.5) / count;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double turn = i * kGoldenAngle;
    const Eigen::Vector3d d = cosine * towards + sine * (std::cos(turn) * u + std::sin(turn) * v);
    directions.row(i) = d.normalized().cast<float>().transpose();
  }
  return directions;
}

Eigen::MatrixX3f compact_cells(const CompactLight& light, const SphereGrid& grid) {
  Eigen::MatrixX3f cells = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  const bool narrow = radians(light.width_deg) < grid.cell_radius();
  const Eigen::MatrixX3f parts = disc_directions(light.direction, light.width_deg, narrow ? 1 : kCellParts);
  const Eigen::RowVector3f each =
      (light.irradiance / (grid.cell_solid_angle() * static_cast<double>(parts.rows()))).cast<float>().transpose();
  for (Eigen::Index i = 0; i < parts.rows(); ++i) {
    const SphereGrid::Interpolation around = grid.interpolate(parts.row(i).transpose());
    for (std::size_t k = 0; k < around.cell.size(); ++k) cells.row(around.cell[k]) += around.weight[k] * each;
  }
  return cells;
}

void add_compact_light(const CompactLight& light, EnvMap& map) {
  const int width = map.width();
  const int height = map.height();
  if (width == 0) return;
  const double texels = solid_angle_sr(light) / texel_solid_angle(height / 2, width, height);
  const int count = std::clamp(static_cast<int>(std::ceil(kPartsATexel * texels)), 1, kMostParts);
  const Eigen::MatrixX3f parts = disc_directions(light.direction, light.width_deg, count);
  for (Eigen::Index i = 0; i < parts.rows(); ++i) {
    const Eigen::Vector2f uv = uv_from_direction(parts.row(i).transpose());
    const double x = static_cast<double>(uv.x()) * width - 0.5;
    const double y = static_cast<double>(uv.y()) * height - 0.5;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    const double across = x - left;
    const double down = y - top;
    for (const auto& [column, row, share] : {std::tuple{left, top, (1 - across) * (1 - down)},
                                             {left + 1, top, across * (1 - down)},
                                             {left, top + 1, (1 - across) * down},
                                             {left + 1, top + 1, across * down}}) {
      const int at_x = ((column % width) + width) % width;
      const int at_y = std::clamp(row, 0, height - 1);  // beyond a pole: its row, at this longitude
      const double density = share / (count * texel_solid_angle(at_y, width, height));
      Eigen::Map<Eigen::Vector3f>(map.radiance().pixel(at_x, at_y)) += (density * light.irradiance).cast<float>();
    }
  }
}

void set_true_size(const CompactLight& light, std::vector<MainLight>& lights) {
  const auto off = [&](const MainLight& main) { return angle_between_deg(main.direction, light.direction); };
  const auto nearest = std::min_element(lights.begin(), lights.end(),
                                        [&](const MainLight& a, const MainLight& b) { return off(a) < off(b); });
  if (nearest == lights.end() || off(*nearest) > kNearestLightDeg) return;
  nearest->direction = light.direction;
  nearest->solid_angle_sr = solid_angle_sr(light);
  nearest->peak_radiance = luminance(light.irradiance.data()) / nearest->solid_angle_sr;
}

}  // namespace faceprobe::lighting

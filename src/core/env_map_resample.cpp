#include "faceprobe/core/env_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace faceprobe {

namespace {

EnvMap rolled(const EnvMap& map, int columns) {
  EnvMap out(map.width(), map.height());
  const int width = map.width();
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const int target = ((x + columns) % width + width) % width;
      std::copy_n(map.radiance().pixel(x, y), 3, out.radiance().pixel(target, y));
    }
  }
  return out;
}

int roll_columns(const EnvMap& map, Orientation orientation) { return static_cast<int>(orientation) * map.width() / 4; }

// Mean over one target texel of the source texels under it, weighted by solid angle. Exact for integer ratios.
EnvMap area_averaged(const EnvMap& map, int width, int height) {
  EnvMap out(width, height);
  const double ratio_x = static_cast<double>(map.width()) / width;
  const double ratio_y = static_cast<double>(map.height()) / height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weight = 0;
      const int first_row = static_cast<int>(std::floor(y * ratio_y));
      const int last_row = std::min(map.height(), static_cast<int>(std::ceil((y + 1) * ratio_y)));
      const int first_column = static_cast<int>(std::floor(x * ratio_x));
      const int last_column = std::min(map.width(), static_cast<int>(std::ceil((x + 1) * ratio_x)));
      for (int row = first_row; row < last_row; ++row) {
        const double overlap_y = std::min<double>(row + 1, (y + 1) * ratio_y) - std::max<double>(row, y * ratio_y);
        const double row_weight = overlap_y * texel_solid_angle(row, map.width(), map.height());
        for (int column = first_column; column < last_column; ++column) {
          const double overlap_x =
              std::min<double>(column + 1, (x + 1) * ratio_x) - std::max<double>(column, x * ratio_x);
          const double w = row_weight * overlap_x;
          sum += w * Eigen::Map<const Eigen::Vector3f>(map.radiance().pixel(column, row)).cast<double>();
          weight += w;
        }
      }
      Eigen::Map<Eigen::Vector3f>(out.radiance().pixel(x, y)) = (sum / weight).cast<float>();
    }
  }
  return out;
}

}  // namespace

EnvMap rotate(const EnvMap& map, const Eigen::Matrix3f& target_from_source) {
  const Eigen::Matrix3f source_from_target = target_from_source.transpose();
  EnvMap out(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3f from = source_from_target * out.direction(x, y);
      Eigen::Map<Eigen::Vector3f>(out.radiance().pixel(x, y)) = map.sample(from);
    }
  }
  return out;
}

EnvMap resize(const EnvMap& map, int width, int height) {
  if (width == map.width() && height == map.height()) return map;
  if (width <= map.width()) return area_averaged(map, width, height);
  EnvMap out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Map<Eigen::Vector3f>(out.radiance().pixel(x, y)) = map.sample(out.direction(x, y));
    }
  }
  return out;
}

EnvMap to_orientation(const EnvMap& map, Orientation orientation) {
  return rolled(map, roll_columns(map, orientation));
}

EnvMap from_orientation(const EnvMap& map, Orientation orientation) {
  return rolled(map, -roll_columns(map, orientation));
}

}  // namespace faceprobe

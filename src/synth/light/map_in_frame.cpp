#include "faceprobe/core/angles.h"
#include "faceprobe/synth/map_light.h"
#include "synth/light/angle_fast.h"
#include "synth/light/cell_lattice.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Energy dropped on a lat-long map, as squares of a given side on the sphere.
class Splat {
 public:
  Splat(int width, int height)
      : width_(width), height_(height),
        sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Eigen::Vector3f::Zero()) {}

  void add(const Eigen::Vector3f& direction, const Eigen::Vector3f& energy, float side) {
    const float ring = std::hypot(direction.x(), direction.z());
    const float v = fast_atan2(ring, direction.y()) * static_cast<float>(height_) / kHalfTurn;
    const float u = (0.5F - fast_atan2(direction.x(), direction.z()) / (2.0F * kHalfTurn)) * static_cast<float>(width_);
    const float down = side * static_cast<float>(height_) / kHalfTurn;
    // Columns narrow towards the poles, where a square may reach all around.
    const float across = std::min(side * static_cast<float>(width_) / (2.0F * kHalfTurn * std::max(ring, 1e-6F)),
                                  static_cast<float>(width_));
    const int last = static_cast<int>(std::floor(v + 0.5F * down));
    for (int y = static_cast<int>(std::floor(v - 0.5F * down)); y <= last; ++y) {
      const float share = overlap(v, down, y);
      if (share <= 0) continue;
      if (y < 0) {  // over the pole: the same row, half a turn away
        add_row(-1 - y, u + 0.5F * static_cast<float>(width_), across, share * energy);
      } else if (y >= height_) {
        add_row(2 * height_ - 1 - y, u + 0.5F * static_cast<float>(width_), across, share * energy);
      } else {
        add_row(y, u, across, share * energy);
      }
    }
  }

  // Radiance, on top of what the map has.
  void add_to(EnvMap& map) const {
    for (int y = 0; y < height_; ++y) {
      const auto per_solid_angle = static_cast<float>(1.0 / texel_solid_angle(y, width_, height_));
      for (int x = 0; x < width_; ++x) {
        const Eigen::Vector3f& sum = sums_[static_cast<std::size_t>(y * width_ + x)];
        for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) += per_solid_angle * sum(c);
      }
    }
  }

 private:
  static constexpr float kHalfTurn = static_cast<float>(kPi);

  // Share of a stretch of `length` about `middle` that lies in [i, i + 1).
  static float overlap(float middle, float length, int i) {
    const float begin = std::max(middle - 0.5F * length, static_cast<float>(i));
    const float end = std::min(middle + 0.5F * length, static_cast<float>(i + 1));
    return (end - begin) / length;
  }

  void add_row(int y, float u, float across, const Eigen::Vector3f& energy) {
    const int last = static_cast<int>(std::floor(u + 0.5F * across));
    for (int x = static_cast<int>(std::floor(u - 0.5F * across)); x <= last; ++x) {
      const float share = overlap(u, across, x);
      if (share <= 0) continue;
      const int column = ((x % width_) + width_) % width_;
      sums_[static_cast<std::size_t>(y * width_ + column)] += share * energy;
    }
  }

  int width_;
  int height_;
  std::vector<Eigen::Vector3f> sums_;
};

// What the cells hold, per channel, radiance x steradian.
Eigen::Vector3d integral_of_cells(const MapLight& map) {
  return map.cells.cast<double>().colwise().sum().transpose() * (4.0 * kPi / static_cast<double>(map.cells.rows()));
}

void scale_to(EnvMap& map, const Eigen::Vector3d& wanted) {
  const Eigen::Vector3d found = map.integral();
  Eigen::Array3f factor = Eigen::Array3f::Ones();
  for (int c = 0; c < 3; ++c) {
    if (found(c) > 0) factor(c) = static_cast<float>(wanted(c) / found(c));
  }
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) Eigen::Map<Eigen::Array3f>(map.radiance().pixel(x, y)) *= factor;
  }
}

// The map without its lights, looked up from every texel of the target.
EnvMap rest_resampled(const MapLight& map, const Eigen::Matrix3f& target_from_map, int width, int height) {
  EnvMap rest = map.radiance;
  for (const MapLight::Covered& covered : map.covered) {
    Eigen::Map<Eigen::Vector3f>(rest.radiance().pixel(covered.x, covered.y)) = covered.rest;
  }
  // A texel that covers several is their mean.
  const int split = std::clamp((map.radiance.height() + height - 1) / height, 1, 8);
  const Eigen::Matrix3f map_from_target = target_from_map.transpose();
  EnvMap out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int k = 0; k < split * split; ++k) {
        const float part_x = (static_cast<float>(k % split) + 0.5F) / static_cast<float>(split);
        const float part_y = (static_cast<float>(k / split) + 0.5F) / static_cast<float>(split);
        const Eigen::Vector2f uv((static_cast<float>(x) + part_x) / static_cast<float>(width),
                                 (static_cast<float>(y) + part_y) / static_cast<float>(height));
        sum += rest.sample(map_from_target * direction_from_uv(uv));
      }
      Eigen::Map<Eigen::Vector3f>(out.radiance().pixel(x, y)) = sum / static_cast<float>(split * split);
    }
  }
  return out;
}

// The same from the cells, turned as a whole and then looked up in rows of constant height.
EnvMap rest_from_cells(const MapLight& map, const Eigen::Matrix3f& target_from_map, int width, int height) {
  constexpr int kSplit = 2;  // points per texel and side
  // Cells about half a texel wide: fewer would blur, more would leave cells between the points.
  const int nside = std::clamp(static_cast<int>(0.6 * height), 4, map.nside);
  const CellLattice lattice(nside);
  CellSums cells = lattice.zero();
  lattice.add(map.directions, target_from_map, map.cells, cells);
  EnvMap out(width, height);
  for (int y = 0; y < kSplit * height; ++y) {
    const float ring = lattice.ring_at(static_cast<float>(std::cos(kPi * (y + 0.5) / (kSplit * height))));
    for (int x = 0; x < kSplit * width; ++x) {
      // Columns run against the turn, and their middle is +z.
      const float turn = 0.5F - (static_cast<float>(x) + 0.5F) / static_cast<float>(kSplit * width);
      const Eigen::Vector4f value = lattice.sample(cells, ring, turn < 0 ? turn + 1.0F : turn);
      Eigen::Map<Eigen::Vector3f>(out.radiance().pixel(x / kSplit, y / kSplit)) += value.head<3>();
    }
  }
  return out;
}

}  // namespace

EnvMap map_in_frame(const MapLight& map, const Eigen::Matrix3f& target_from_map, const Eigen::Vector3f& gain, int width,
                    int height) {
  // Where a texel is wider than a cell, the cells have all there is to see, and there are far fewer of them.
  const auto cell_side = std::sqrt(4.0 * kPi / static_cast<double>(map.cells.rows()));
  const auto texel_side = kPi / height;
  EnvMap out = texel_side >= cell_side ? rest_from_cells(map, target_from_map, width, height)
                                       : rest_resampled(map, target_from_map, width, height);
  Eigen::Vector3d wanted = integral_of_cells(map);
  scale_to(out, wanted);
  Splat splat(width, height);
  for (const DistantLight& light : map.distant) {
    splat.add(target_from_map * light.direction, light.irradiance, static_cast<float>(texel_side));
    wanted += light.irradiance.cast<double>();
  }
  splat.add_to(out);
  scale_to(out, wanted.cwiseProduct(gain.cast<double>()));
  return out;
}

}  // namespace faceprobe::synth

#include "synth/light/find_lights.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace faceprobe::synth {
namespace {

// A light that gives less than this share of a map's whole is not worth a shadow ray per point.
constexpr double kLeastShare = 0.01;
// Discs that are tried about a light, the smallest first, so that little of its surround is flattened: the radius in parts of the
// largest, and how bright it may be around (mean radiance over the mean within, both above the surround; a lamp that goes on
// beyond the disc has about 1). A smaller disc has to hold all of the glare, the largest is allowed to leave some.
struct Disc {
  double radius;
  double most_around;
};
constexpr std::array<Disc, 6> kDiscs = {{{0.4, 0.02}, {0.6, 0.02}, {0.8, 0.03}, {1.0, 0.15}, {1.6, 0.1}, {2.5, 0.1}}};
// What is larger than one light may be, a lamp's shade or a softbox, becomes several: one in the middle and six around it.
constexpr int kAround = 6;
constexpr double kAroundAt = 0.68;  // of the disc's radius: the middle of the ring's area
constexpr double kLeastSplitShare =
    0.15;  // of the map's whole: seven rays a point are for what throws the picture's main shadow
// The ring that is looked at as the surround reaches this much further than the disc, and at least two texels.
constexpr double kRing = 1.6;

struct Texel {
  int x, y;
  double solid_angle;
  Eigen::Vector3d direction;
};

class Finder {
 public:
  Finder(const EnvMap& map, double max_radius)
      : rest_(map), max_radius_(max_radius), texel_(kPi / map.height()), luminance_(map.radiance().pixel_count()),
        done_(map.radiance().pixel_count(), 0) {
    for (int y = 0; y < map.height(); ++y) {
      double row = 0;
      for (int x = 0; x < map.width(); ++x) {
        luminance_[index(x, y)] = luminance(map.radiance().pixel(x, y));
        row += static_cast<double>(luminance_[index(x, y)]);
      }
      total_ += row * texel_solid_angle(y, map.width(), map.height());
      const double theta = kPi * (y + 0.5) / map.height();
      row_.emplace_back(std::sin(theta), std::cos(theta));
    }
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3d level =
          direction_from_uv({(static_cast<float>(x) + 0.5F) / static_cast<float>(map.width()), 0.5F}).cast<double>();
      column_.emplace_back(level.x(), level.z());
    }
  }

  FoundLights find(int max_count) {
    FoundLights found;
    const double largest_disc = 2.0 * kPi * (1.0 - std::cos(kDiscs.back().radius * max_radius_));
    while (static_cast<int>(found.lights.size()) < max_count) {
      const std::size_t peak = brightest_left();
      if (peak >= luminance_.size()) break;
      // Even a full disc of this radiance would be too little: what follows is darker still.
      if (static_cast<double>(luminance_[peak]) * largest_disc < kLeastShare * total_) break;
      const auto width = static_cast<std::size_t>(rest_.width());
      const std::vector<DistantLight> lights = take(static_cast<int>(peak % width), static_cast<int>(peak / width));
      if (lights.size() == 1) add(lights.front(), found.lights);
      if (lights.size() > 1) found.lights.insert(found.lights.end(), lights.begin(), lights.end());
    }
    found.rest = std::move(rest_);
    return found;
  }

 private:
  // What is left of a light's glare may be found as a light again: it becomes part of the first.
  void add(const DistantLight& light, std::vector<DistantLight>& lights) const {
    for (DistantLight& other : lights) {
      const double apart = angle_between_deg(other.direction.cast<double>(), light.direction.cast<double>());
      if (radians(apart) > max_radius_) continue;
      const float share = luminance(light.irradiance.data());
      other.direction = (other.direction * luminance(other.irradiance.data()) + light.direction * share).normalized();
      other.irradiance += light.irradiance;
      return;
    }
    lights.push_back(light);
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(rest_.width()) + static_cast<std::size_t>(x);
  }

  // EnvMap::direction from tables, because all texels about every peak are asked many times.
  Eigen::Vector3d direction_of(int x, int y) const {
    const Eigen::Vector2d& column = column_[static_cast<std::size_t>(x)];
    const Eigen::Vector2d& row = row_[static_cast<std::size_t>(y)];
    return {row.x() * column.x(), row.y(), row.x() * column.y()};
  }

  std::size_t brightest_left() const {
    std::size_t best = luminance_.size();
    float most = 0;
    for (std::size_t i = 0; i < luminance_.size(); ++i) {
      if (luminance_[i] > most && !done_[i]) {
        most = luminance_[i];
        best = i;
      }
    }
    return best;
  }

  // Texels whose centres lie within `radius` of a direction.
  std::vector<Texel> texels_within(const Eigen::Vector3d& centre, double radius) const {
    std::vector<Texel> texels;
    const double least_cosine = std::cos(radius);
    const int width = rest_.width();
    const int height = rest_.height();
    const double theta = std::acos(std::clamp(centre.y(), -1.0, 1.0));
    const int first = std::max(0, static_cast<int>(std::floor((theta - radius) / texel_)));
    const int last = std::min(height - 1, static_cast<int>(std::ceil((theta + radius) / texel_)));
    const double column = static_cast<double>(uv_from_direction(centre.cast<float>()).x()) * width;
    for (int y = first; y <= last; ++y) {
      // Half the width of the disc in this row, generously; near a pole it is the whole row.
      const double sine = std::min(std::sin(theta), std::sin(kPi * (y + 0.5) / height));
      const double reach = sine > 0 ? 1.2 * radius / sine / (2.0 * kPi) * width + 1.0 : width;
      const int half = std::min(width / 2, static_cast<int>(std::ceil(reach)));
      const int begin = static_cast<int>(std::floor(column)) - half;
      for (int i = 0; i < std::min(width, 2 * half + 1); ++i) {
        const int x = ((begin + i) % width + width) % width;
        const Eigen::Vector3d direction = direction_of(x, y);
        if (direction.dot(centre) < least_cosine) continue;
        texels.push_back({x, y, texel_solid_angle(y, width, height), direction});
      }
    }
    return texels;
  }

  Eigen::Vector3f median(const std::vector<Texel>& texels) const {
    Eigen::Vector3f result;
    for (int c = 0; c < 3; ++c) {
      std::vector<float> values(texels.size());
      std::transform(texels.begin(), texels.end(), values.begin(),
                     [&](const Texel& t) { return rest_.radiance()(t.x, t.y, c); });
      result(c) = upper_median_of(std::move(values));
    }
    return result;
  }

  // Luminance over the surround's, integrated, and its centroid.
  double excess(const std::vector<Texel>& texels, float surround, Eigen::Vector3d* centroid = nullptr) const {
    double sum = 0;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Texel& t : texels) {
      const double over = t.solid_angle * std::max(0.0, static_cast<double>(luminance_[index(t.x, t.y)] - surround));
      sum += over;
      middle += over * t.direction;
    }
    if (centroid && sum > 0) *centroid = middle.normalized();
    return sum;
  }

  static double area(const std::vector<Texel>& texels) {
    double sum = 0;
    for (const Texel& t : texels) sum += t.solid_angle;
    return sum;
  }

  // The light about a peak, taken out of the map, in one or several parts; nothing when it is too large or too weak. Either way its
  // place is done.
  std::vector<DistantLight> take(int x, int y) {
    const Eigen::Vector3d peak = direction_of(x, y);
    done_[index(x, y)] = 1;
    for (const Disc& tried : kDiscs) {
      const double radius = tried.radius * max_radius_;
      const double outer = std::max(kRing * radius, radius + 2.0 * texel_);
      const double least_cosine = std::cos(radius);
      Eigen::Vector3d centre = peak;
      std::vector<Texel> disc, ring;
      Eigen::Vector3f surround;
      double inside = 0;
      for (int round = 0; round < 3; ++round) {  // the brightest texel need not be the middle
        disc.clear();
        ring.clear();
        for (const Texel& t : texels_within(centre, outer)) {
          (t.direction.dot(centre) >= least_cosine ? disc : ring).push_back(t);
        }
        if (disc.empty() || ring.empty()) return {};  // texels larger than lights
        surround = median(ring);
        inside = excess(disc, luminance(surround.data()), &centre);
      }
      const double around = excess(ring, luminance(surround.data())) / area(ring);
      if (around > tried.most_around * inside / area(disc)) continue;
      for (const Texel& t : disc) done_[index(t.x, t.y)] = 1;
      if (inside < (tried.radius > 1.0 ? kLeastSplitShare : kLeastShare) * total_) return {};
      return tried.radius > 1.0 ? cut_in_parts(disc, surround, centre, radius)
                                : std::vector<DistantLight>{cut(disc, surround, centre)};
    }
    for (const Texel& t : texels_within(peak, 0.5 * max_radius_)) done_[index(t.x, t.y)] = 1;
    return {};
  }

  // Each part at its own centroid, so that the direction of the whole is kept.
  std::vector<DistantLight> cut_in_parts(const std::vector<Texel>& disc, const Eigen::Vector3f& surround,
                                         const Eigen::Vector3d& centre, double radius) {
    std::vector<Eigen::Vector3d> middles = {centre};
    const Eigen::Vector3d side = centre.unitOrthogonal();
    const Eigen::Vector3d other = centre.cross(side);
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * kPi * k / kAround;
      const double away = std::tan(kAroundAt * radius);
      middles.push_back((centre + away * (std::cos(angle) * side + std::sin(angle) * other)).normalized());
    }
    std::vector<std::vector<Texel>> parts(middles.size());
    for (const Texel& t : disc) {
      const auto nearest = std::max_element(middles.begin(), middles.end(), [&](const auto& a, const auto& b) {
        return a.dot(t.direction) < b.dot(t.direction);
      });
      parts[static_cast<std::size_t>(nearest - middles.begin())].push_back(t);
    }
    std::vector<DistantLight> lights;
    for (const std::vector<Texel>& part : parts) {
      Eigen::Vector3d middle = centre;
      if (part.empty() || excess(part, luminance(surround.data()), &middle) <= 0) continue;
      lights.push_back(cut(part, surround, middle));
    }
    return lights;
  }

  DistantLight cut(const std::vector<Texel>& disc, const Eigen::Vector3f& surround, const Eigen::Vector3d& centre) {
    Eigen::Vector3d irradiance = Eigen::Vector3d::Zero();
    for (const Texel& t : disc) {
      Eigen::Map<Eigen::Vector3f> radiance(rest_.radiance().pixel(t.x, t.y));
      const Eigen::Vector3f kept = radiance.cwiseMin(surround);
      irradiance += t.solid_angle * (radiance.cast<double>() - kept.cast<double>());
      radiance = kept;
      luminance_[index(t.x, t.y)] = luminance(kept.data());
    }
    return {centre.cast<float>(), irradiance.cast<float>()};
  }

  EnvMap rest_;
  double max_radius_;
  double texel_;  // radians
  std::vector<float> luminance_;
  std::vector<std::uint8_t> done_;       // looked at already
  double total_ = 0;                     // luminance over the sphere
  std::vector<Eigen::Vector2d> row_;     // sine and cosine of the angle from the pole
  std::vector<Eigen::Vector2d> column_;  // x and z of directions on the equator
};

}  // namespace

FoundLights find_lights(const EnvMap& map, int max_count, float max_radius) {
  return Finder(map, static_cast<double>(max_radius)).find(max_count);
}

}  // namespace faceprobe::synth

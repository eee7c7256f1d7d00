#include "render/light_set.h"

#include "render/numbers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::render {
namespace {

constexpr float kLeastMapChance = 0.2F;

// 1 - cosine of the ball's apparent radius, without cancellation; 2 from inside.
float cap_of(const BallLamp& lamp, float distance2) {
  const float sine2 = lamp.radius_m * lamp.radius_m / distance2;
  return sine2 >= 1 ? 2 : sine2 / (1 + std::sqrt(1 - sine2));
}

Eigen::Vector3f radiance_of(const BallLamp& lamp) { return lamp.intensity / (kPi32 * lamp.radius_m * lamp.radius_m); }

}  // namespace

LightSet::LightSet(const EnvMap& map, const std::vector<BallLamp>& lamps, const Eigen::Vector3f& centre)
    : map_(map), lamps_(lamps) {
  float sum = 0;
  for (const BallLamp& lamp : lamps_) {
    chance_.push_back(lamp.intensity.mean() / std::max(1e-4F, (lamp.position_m - centre).squaredNorm()));
    sum += chance_.back();
  }
  if (!(sum > 0)) {
    lamps_.clear();
    chance_.clear();
    return;
  }
  map_chance_ = std::max(kLeastMapChance, kPi32 * map_.mean() / (kPi32 * map_.mean() + sum));
  for (float& chance : chance_) chance *= (1 - map_chance_) / sum;
}

LightSet::Seen LightSet::map_along(const Eigen::Vector3f& direction) const {
  const MapSampler::Seen seen = map_.look(direction);
  return {direction, seen.radiance, map_chance_ * seen.density, std::numeric_limits<float>::infinity()};
}

LightSet::Seen LightSet::draw(const Eigen::Vector3f& from, float choice, const Eigen::Vector2f& random) const {
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    if (choice < chance_[i]) return draw_lamp(i, from, random);
    choice -= chance_[i];
  }
  const MapSampler::Seen seen = map_.draw(random);
  return {seen.direction, seen.radiance, map_chance_ * seen.density, std::numeric_limits<float>::infinity()};
}

LightSet::Seen LightSet::draw_lamp(std::size_t lamp, const Eigen::Vector3f& from, const Eigen::Vector2f& random) const {
  const Eigen::Vector3f way = lamps_[lamp].position_m - from;
  const float distance2 = way.squaredNorm();
  const float cap = cap_of(lamps_[lamp], distance2);
  if (cap >= 2) return {Eigen::Vector3f::UnitZ()};  // inside it: nothing sensible
  const float height = 1 - random.x() * cap;
  const float radius = std::sqrt(std::max(0.0F, 1 - height * height));
  const float phi = 2 * kPi32 * random.y();
  const Eigen::Vector3f axis = way.normalized();
  const Eigen::Vector3f side = axis.unitOrthogonal();
  const Eigen::Vector3f direction =
      (height * axis + radius * (std::cos(phi) * side + std::sin(phi) * axis.cross(side))).normalized();
  return lamp_along(from, direction, std::numeric_limits<float>::infinity());
}

LightSet::Seen LightSet::lamp_along(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float far) const {
  Seen seen{direction};
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const Eigen::Vector3f way = lamps_[i].position_m - from;
    const float along = way.dot(direction);
    const float inside2 = lamps_[i].radius_m * lamps_[i].radius_m - (way - along * direction).squaredNorm();
    if (along <= 0 || inside2 <= 0) continue;
    const float distance = along - std::sqrt(inside2);
    const float cap = cap_of(lamps_[i], way.squaredNorm());
    if (distance <= 0 || distance >= far || cap >= 2) continue;
    seen.density += chance_[i] / (2 * kPi32 * cap);
    seen.radiance += radiance_of(lamps_[i]);
    seen.distance = seen.distance > 0 ? std::min(seen.distance, distance) : distance;
  }
  return seen;
}

}  // namespace faceprobe::render

#include "faceprobe/synth/procedural_maps.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

struct Lamp {
  double azimuth_deg, height_deg, radius_deg;
  Eigen::Vector3f radiance;
};

struct Surroundings {
  const char* name;
  Eigen::Vector3f up, level, down;
  std::vector<Lamp> lamps;
};

Eigen::Vector3f direction_of(const Lamp& lamp) {
  const double azimuth = radians(lamp.azimuth_deg);
  const double height = radians(lamp.height_deg);
  return Eigen::Vector3d(std::sin(azimuth) * std::cos(height), std::sin(height), std::cos(azimuth) * std::cos(height))
      .cast<float>();
}

EnvMap paint(const Surroundings& place) {
  EnvMap map(256, 128);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3f d = map.direction(x, y);
      const float s = std::clamp(0.5F + 2.0F * d.y(), 0.0F, 1.0F);
      Eigen::Vector3f light = d.y() >= 0 ? Eigen::Vector3f(place.level + (place.up - place.level) * std::sqrt(d.y()))
                                         : Eigen::Vector3f(place.down);
      light = s * light + (1.0F - s) * place.down;
      for (const Lamp& lamp : place.lamps) {
        const double angle = degrees(std::acos(std::clamp(static_cast<double>(d.dot(direction_of(lamp))), -1.0, 1.0)));
        // Soft over half a texel row, so that the lamp's size does not jump with the grid.
        const double inside = std::clamp((lamp.radius_deg - angle) / 1.4 + 0.5, 0.0, 1.0);
        light += static_cast<float>(inside) * lamp.radiance;
      }
      for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = light(c);
    }
  }
  const auto mean = static_cast<float>(map.integral().mean() / (4 * kPi));
  for (float& value : map.radiance().values()) value /= mean;
  return map;
}

}  // namespace

std::vector<std::pair<std::string, EnvMap>> procedural_maps() {
  const std::vector<Surroundings> places = {
      {"overcast", {1.0F, 1.05F, 1.1F}, {0.7F, 0.72F, 0.75F}, {0.15F, 0.14F, 0.12F}, {}},
      {"noon", {0.3F, 0.5F, 0.9F}, {0.8F, 0.85F, 0.9F}, {0.25F, 0.22F, 0.18F}, {{40, 55, 1.5, {900, 850, 760}}}},
      {"evening", {0.2F, 0.25F, 0.4F}, {0.8F, 0.5F, 0.35F}, {0.12F, 0.1F, 0.08F}, {{-75, 8, 2, {260, 130, 60}}}},
      {"window", {0.12F, 0.1F, 0.08F}, {0.1F, 0.09F, 0.08F}, {0.06F, 0.05F, 0.04F}, {{70, 12, 18, {6, 6.5F, 7}}}},
      {"room",
       {0.25F, 0.22F, 0.18F},
       {0.18F, 0.15F, 0.12F},
       {0.1F, 0.08F, 0.06F},
       {{10, 70, 6, {30, 24, 16}}, {-130, 30, 4, {20, 16, 11}}}},
      {"studio",
       {0.03F, 0.03F, 0.03F},
       {0.05F, 0.05F, 0.05F},
       {0.03F, 0.03F, 0.03F},
       {{-45, 30, 14, {9, 9, 9}}, {60, 10, 20, {1.2F, 1.2F, 1.2F}}, {170, 35, 8, {6, 6, 7}}}},
  };
  std::vector<std::pair<std::string, EnvMap>> maps;
  maps.reserve(places.size());
  for (const Surroundings& place : places) maps.emplace_back(place.name, paint(place));
  return maps;
}

}  // namespace faceprobe::synth

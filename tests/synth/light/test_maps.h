#pragma once
// Maps whose lights are known.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/env_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {

constexpr int kTestWidth = 256;

// A bright sky over a dark ground, in colour and smooth.
inline EnvMap sky(int width = kTestWidth) {
  EnvMap map(width, width / 2);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3f d = map.direction(x, y);
      map.radiance()(x, y, 0) = 0.5F + 0.3F * d.y() + 0.1F * d.x();
      map.radiance()(x, y, 1) = 0.6F + 0.4F * d.y();
      map.radiance()(x, y, 2) = 0.8F + 0.6F * d.y() - 0.1F * d.z();
    }
  }
  return map;
}

// Adds a disc of even radiance with a soft edge of one texel.
inline void add_lamp(EnvMap& map, const Eigen::Vector3f& direction, double radius_deg, const Eigen::Vector3f& radiance) {
  const double edge = 180.0 / map.height();
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const double angle = angle_between_deg(map.direction(x, y).cast<double>(), direction.cast<double>());
      const double share = std::clamp((radius_deg - angle) / edge + 0.5, 0.0, 1.0);
      Eigen::Map<Eigen::Vector3f>(map.radiance().pixel(x, y)) += static_cast<float>(share) * radiance;
    }
  }
}

inline Eigen::Matrix3f some_rotation() {
  return (Eigen::AngleAxisf(0.7F, Eigen::Vector3f::UnitY()) * Eigen::AngleAxisf(-0.4F, Eigen::Vector3f::UnitX()) *
          Eigen::AngleAxisf(2.1F, Eigen::Vector3f(1, 2, 3).normalized()))
      .toRotationMatrix();
}

}  // namespace faceprobe::synth

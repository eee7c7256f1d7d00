#include "faceprobe/core/env_map.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe {

Eigen::Vector3f direction_from_uv(const Eigen::Vector2f& uv) {
  const double phi = 2.0 * kPi * (static_cast<double>(uv.x()) - 0.5);
  const double theta = kPi * static_cast<double>(uv.y());
  return Eigen::Vector3d(-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)).cast<float>();
}

Eigen::Vector2f uv_from_direction(const Eigen::Vector3f& direction) {
  const Eigen::Vector3d d = direction.cast<double>();
  const double u = 0.5 - std::atan2(d.x(), d.z()) / (2.0 * kPi);
  const double v = std::atan2(std::hypot(d.x(), d.z()), d.y()) / kPi;
  const auto rounded = static_cast<float>(u);  // may reach 1 although u did not
  return {rounded >= 1.0F ? 0.0F : rounded, static_cast<float>(v)};
}

float solid_angle_density(float v) {
  return static_cast<float>(2.0 * kPi * kPi * std::sin(kPi * static_cast<double>(v)));
}

double texel_solid_angle(int y, int width, int height) {
  const double top = std::cos(kPi * y / height);
  const double bottom = std::cos(kPi * (y + 1) / height);
  return 2.0 * kPi / width * (top - bottom);
}

EnvMap::EnvMap(int width, int height) : EnvMap(Image(std::max(width, 0), std::max(height, 0), 3)) {}

EnvMap::EnvMap(Image radiance) : radiance_(std::move(radiance)) {
  if (radiance_.empty() || radiance_.width() != 2 * radiance_.height() || radiance_.channels() != 3) {
    throw std::invalid_argument("An environment map must be 2N x N with three channels.");
  }
}

Eigen::Vector3f EnvMap::direction(int x, int y) const {
  return direction_from_uv({(static_cast<float>(x) + 0.5F) / static_cast<float>(width()),
                            (static_cast<float>(y) + 0.5F) / static_cast<float>(height())});
}

Eigen::Vector3f EnvMap::sample(const Eigen::Vector3f& direction) const {
  const Eigen::Vector2f uv = uv_from_direction(direction);
  const float x = uv.x() * static_cast<float>(width()) - 0.5F;
  const float y = uv.y() * static_cast<float>(height()) - 0.5F;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const auto texel = [this](int column, int row) -> Eigen::Vector3f {
    if (row < 0 || row >= height()) {  // over the pole: the same row, half a turn away
      row = row < 0 ? -1 - row : 2 * height() - 1 - row;
      column += width() / 2;
    }
    column = ((column % width()) + width()) % width();
    return Eigen::Map<const Eigen::Vector3f>(radiance_.pixel(column, row));
  };
  return (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
         fy * ((1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
}

Eigen::Vector3d EnvMap::integral() const {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (int y = 0; y < height(); ++y) {
    Eigen::Vector3d row = Eigen::Vector3d::Zero();
    for (int x = 0; x < width(); ++x) row += Eigen::Map<const Eigen::Vector3f>(radiance_.pixel(x, y)).cast<double>();
    total += row * texel_solid_angle(y, width(), height());
  }
  return total;
}

}  // namespace faceprobe

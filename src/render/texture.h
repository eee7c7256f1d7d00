#pragma once
// Textures looked up.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <cmath>

namespace faceprobe::render {

// Bilinear, repeated in both directions; v up. `texture`: three channels, not empty.
inline Eigen::Vector3f texel(const Image& texture, const Eigen::Vector2f& uv) {
  const float x = (uv.x() - std::floor(uv.x())) * static_cast<float>(texture.width()) - 0.5F;
  const float y = (1 - (uv.y() - std::floor(uv.y()))) * static_cast<float>(texture.height()) - 0.5F;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const auto at = [&](int i, int j) -> Eigen::Vector3f {
    i = (i + texture.width()) % texture.width();
    j = (j + texture.height()) % texture.height();
    return Eigen::Map<const Eigen::Vector3f>(texture.pixel(i, j));
  };
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
         fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
}

}  // namespace faceprobe::render

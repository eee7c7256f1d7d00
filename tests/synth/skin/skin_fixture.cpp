#include "synth/skin/skin_fixture.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth::testing {

ByteImage plain_texture(int size_px, std::array<std::uint8_t, 3> colour) {
  ByteImage texture(size_px, size_px, 3);
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) std::copy(colour.begin(), colour.end(), texture.pixel(x, y));
  }
  return texture;
}

ByteImage varied_texture(int size_px) {
  ByteImage texture = plain_texture(size_px, {190, 150, 130});
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      const double wave = 14 * std::sin(12.0 * x / size_px) * std::cos(9.0 * y / size_px);
      for (int c = 0; c < 3; ++c)
        texture(x, y, c) = static_cast<std::uint8_t>(texture(x, y, c) + static_cast<int>(wave));
      if (x > 3 * size_px / 4 && y < size_px / 8)
        texture(x, y, 0) = texture(x, y, 1) = texture(x, y, 2) = 20;                             // a brow
      if (x > 3 * size_px / 4 && y > 7 * size_px / 8) texture(x, y, 1) = texture(x, y, 2) = 70;  // a lip
    }
  }
  return texture;
}

SkinPoints texel_points(int size_px) {
  const int count = size_px * size_px;
  SkinPoints points{Eigen::MatrixX2f(count, 2),
                    Eigen::MatrixX3f(count, 3),
                    std::vector<Region>(static_cast<std::size_t>(count), Region::kCheeks),
                    {},
                    {}};
  for (int y = 0; y < size_px; ++y) {
    for (int x = 0; x < size_px; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(size_px);
      const float v = 1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(size_px);
      points.uv.row(y * size_px + x) << u, v;
      points.rest_position.row(y * size_px + x) << 0.1F * (u - 0.5F), 0.1F * (v - 0.7F), 0.0F;
    }
  }
  return points;
}

SkinPoints scattered_points(int count, std::uint64_t seed) {
  Random random({seed});
  SkinPoints points{
      {}, Eigen::MatrixX3f(count, 3), std::vector<Region>(static_cast<std::size_t>(count), Region::kCheeks), {}, {}};
  for (int i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) points.rest_position(i, axis) = static_cast<float>(random.between(-0.1, 0.1));
  }
  return points;
}

}  // namespace faceprobe::synth::testing

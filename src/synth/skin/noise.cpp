#include "synth/skin/noise.h"

#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

float fade(float t) { return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F); }
float fade_slope(float t) { return 30.0F * t * t * (1.0F - t) * (1.0F - t); }

// Truncation is many times faster than std::floor without SSE 4.1.
std::int32_t floor_int(float x) {
  const auto whole = static_cast<std::int32_t>(x);
  return whole - static_cast<std::int32_t>(x < static_cast<float>(whole));
}

// One of the twelve edge directions of a cube.
float edge_dot(std::uint32_t bits, float x, float y, float z, Eigen::Vector3f& edge) {
  static constexpr std::array<std::array<float, 3>, 12> kEdges = {{{1, 1, 0},
                                                                   {-1, 1, 0},
                                                                   {1, -1, 0},
                                                                   {-1, -1, 0},
                                                                   {1, 0, 1},
                                                                   {-1, 0, 1},
                                                                   {1, 0, -1},
                                                                   {-1, 0, -1},
                                                                   {0, 1, 1},
                                                                   {0, -1, 1},
                                                                   {0, 1, -1},
                                                                   {0, -1, -1}}};
  const auto& e = kEdges[((bits >> 8U) * 12U) >> 24U];
  edge = Eigen::Vector3f(e[0], e[1], e[2]);
  return e[0] * x + e[1] * y + e[2] * z;
}

}  // namespace

std::uint32_t noise_key(std::uint64_t seed, std::uint32_t purpose) {
  return cell_bits({static_cast<std::int32_t>(seed & 0x7FFFFFFFU), static_cast<std::int32_t>(seed >> 33U),
                    static_cast<std::int32_t>(purpose)},
                   static_cast<std::uint32_t>(seed >> 31U) * 0x9E3779B9U + purpose);
}

float value_noise(const Eigen::Vector3f& point, std::uint32_t key) {
  // Values uniform in [-1, 1] have variance 1/3; the blend leaves (2 * 181/462)^3 of it.
  static constexpr float kScale = 2.4973F;
  const Cell cell{floor_int(point.x()), floor_int(point.y()), floor_int(point.z())};
  const float fx = fade(point.x() - static_cast<float>(cell.x));
  const float fy = fade(point.y() - static_cast<float>(cell.y));
  const float fz = fade(point.z() - static_cast<float>(cell.z));
  const auto row = [&](int dy, int dz) {
    const float a = unit_float(cell_bits({cell.x, cell.y + dy, cell.z + dz}, key));
    const float b = unit_float(cell_bits({cell.x + 1, cell.y + dy, cell.z + dz}, key));
    return a + fx * (b - a);
  };
  const float near = row(0, 0) + fy * (row(1, 0) - row(0, 0));
  const float far = row(0, 1) + fy * (row(1, 1) - row(0, 1));
  return kScale * (2.0F * (near + fz * (far - near)) - 1.0F);
}

Eigen::Vector3f noise_gradient(const Eigen::Vector3f& point, std::uint32_t key) {
  // With independent gradients of mean square 2/3 per component, the noise's derivative has the mean square
  // 8 * 2/3 * (D2 A0^2 + 2 D0 A2 A0), A and D being integrals over [0, 1] of the squared blend and its squared slope, times t^2
  // where the index is 2: A0 = 181/462, A2 = .029693, D0 = 10/7, D2 = .38961.
  static constexpr float kScale = 1.41962F;
  const Cell cell{floor_int(point.x()), floor_int(point.y()), floor_int(point.z())};
  const float x = point.x() - static_cast<float>(cell.x);
  const float y = point.y() - static_cast<float>(cell.y);
  const float z = point.z() - static_cast<float>(cell.z);
  const std::array<float, 2> wx = {1.0F - fade(x), fade(x)};
  const std::array<float, 2> wy = {1.0F - fade(y), fade(y)};
  const std::array<float, 2> wz = {1.0F - fade(z), fade(z)};
  const std::array<float, 2> sx = {-fade_slope(x), fade_slope(x)};
  const std::array<float, 2> sy = {-fade_slope(y), fade_slope(y)};
  const std::array<float, 2> sz = {-fade_slope(z), fade_slope(z)};
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner & 1U;
    const std::size_t j = (corner >> 1U) & 1U;
    const std::size_t k = corner >> 2U;
    Eigen::Vector3f edge;
    const float value = edge_dot(
        cell_bits({cell.x + static_cast<int>(i), cell.y + static_cast<int>(j), cell.z + static_cast<int>(k)}, key),
        x - static_cast<float>(i), y - static_cast<float>(j), z - static_cast<float>(k), edge);
    gradient += wx[i] * wy[j] * wz[k] * edge +
                value * Eigen::Vector3f(sx[i] * wy[j] * wz[k], wx[i] * sy[j] * wz[k], wx[i] * wy[j] * sz[k]);
  }
  return kScale * gradient;
}

}  // namespace faceprobe::synth

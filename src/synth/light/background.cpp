#include "faceprobe/core/angles.h"
#include "faceprobe/synth/map_light.h"
#include "synth/light/angle_fast.h"
#include "synth/light/blur.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace faceprobe::synth {
namespace {

// Points of the picture in even steps, and what the map shows there.
struct Lattice {
  int columns, rows;
  float first, step;  // pixel coordinate of point 0 along both axes, and of the next less that
};

struct Planes3 {
  explicit Planes3(std::size_t size) : red(size), green(size), blue(size) {}
  std::vector<float> red, green, blue;
};

// Weights of the quadratic B-spline at a place `part` off the middle of three samples, -1/2 .. 1/2. It has no negative lobes, so a
// sun gets no dark ring, and no creases where texels meet.
struct Spline {
  explicit Spline(float part)
      : before(0.5F * (0.5F - part) * (0.5F - part)), after(0.5F * (0.5F + part) * (0.5F + part)) {
    middle = 1.0F - before - after;
  }
  float before, middle, after;
};

Eigen::Vector4f texel(const EnvMap& map, int x, int y) {
  if (y < 0 || y >= map.height()) {  // over the pole: the same row, half a turn away
    y = y < 0 ? -1 - y : 2 * map.height() - 1 - y;
    x += map.width() / 2;
  }
  x = ((x % map.width()) + map.width()) % map.width();
  const float* p = map.radiance().pixel(x, y);
  return {p[0], p[1], p[2], 0.0F};
}

// u, v: texel coordinates, texel centres at .5.
Eigen::Vector4f smooth_texel(const EnvMap& map, float u, float v) {
  const int x = static_cast<int>(u);
  const int y = std::min(static_cast<int>(v), map.height() - 1);
  const Spline across(u - static_cast<float>(x) - 0.5F);
  const Spline down(std::min(v - static_cast<float>(y), 1.0F) - 0.5F);
  const float rows[3] = {down.before, down.middle, down.after};
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  if (x >= 1 && x + 2 < map.width() && y >= 1 && y + 1 < map.height()) {
    for (int k = 0; k < 3; ++k) {
      // Loads of four floats from texels of three: the fourth is the next texel's, which is in the picture, and not used.
      const float* p = map.radiance().pixel(x - 1, y - 1 + k);
      using Load = Eigen::Map<const Eigen::Vector4f>;
      sum += rows[k] * (across.before * Load(p) + across.middle * Load(p + 3) + across.after * Load(p + 6));
    }
    return sum;
  }
  for (int k = 0; k < 3; ++k) {
    const int row = y - 1 + k;
    sum += rows[k] * (across.before * texel(map, x - 1, row) + across.middle * texel(map, x, row) +
                      across.after * texel(map, x + 1, row));
  }
  return sum;
}

void draw(const EnvMap& map, const PinholeCamera& camera, const Eigen::Matrix3f& camera_from_map,
          const Lattice& lattice, Planes3& out) {
  const Eigen::Matrix3f map_from_camera = camera_from_map.transpose();
  const auto columns = static_cast<std::size_t>(lattice.columns);
  std::vector<float> us(columns), vs(columns);
  const auto width = static_cast<float>(map.width());
  const auto height = static_cast<float>(map.height());
  const float per_turn = width / static_cast<float>(2 * kPi);
  const float per_half = height / static_cast<float>(kPi);
  // Rays need no unit length here, so along a row they are a straight line.
  const Eigen::Vector3f right = map_from_camera.col(0) * (lattice.step / camera.focal_px);
  for (int j = 0; j < lattice.rows; ++j) {
    const float y_px = lattice.first + lattice.step * static_cast<float>(j);
    const Eigen::Vector3f start =
        map_from_camera * Eigen::Vector3f((lattice.first - camera.centre_px.x()) / camera.focal_px,
                                          (camera.centre_px.y() - y_px) / camera.focal_px, -1.0F);
    const float x0 = start.x(), y0 = start.y(), z0 = start.z();
    const float dx = right.x(), dy = right.y(), dz = right.z();
    for (int i = 0; i < lattice.columns; ++i) {
      const auto k = static_cast<float>(i);
      const float x = x0 + k * dx;
      const float y = y0 + k * dy;
      const float z = z0 + k * dz;
      const float u = 0.5F * width - per_turn * fast_atan2(x, z);
      us[static_cast<std::size_t>(i)] = u < 0.0F ? u + width : u >= width ? u - width : u;
      vs[static_cast<std::size_t>(i)] = per_half * fast_atan2(std::sqrt(x * x + z * z), y);
    }
    const std::size_t row = static_cast<std::size_t>(j) * columns;
    for (std::size_t i = 0; i < columns; ++i) {
      const Eigen::Vector4f value = smooth_texel(map, us[i], vs[i]);
      out.red[row + i] = value(0);
      out.green[row + i] = value(1);
      out.blue[row + i] = value(2);
    }
  }
}

}  // namespace

Image draw_background(const MapLight& map, const PinholeCamera& camera, const Eigen::Matrix3f& camera_from_map,
                      const Eigen::Vector3f& gain, float blur_px) {
  assert(blur_px >= 0 && blur_px <= 192);
  Image picture(camera.width_px, camera.height_px, 3);
  if (picture.empty()) return picture;
  // A defocused picture has nothing finer than its blur: it is drawn on a coarser lattice and stretched, which blurs by 1/6 of a
  // step's square (a triangle's variance). The lattice goes on beyond the picture, so that what is outside blurs into it.
  int step = 1;
  while (blur_px >= 2.0F * static_cast<float>(step) && step < 8) step *= 2;
  const float in_steps = blur_px / static_cast<float>(step);
  const float stretched = step > 1 ? 1.0F / 6.0F : 0.0F;
  const std::vector<float> kernel = gaussian_kernel(std::sqrt(std::max(0.0F, in_steps * in_steps - stretched)));
  const int margin = static_cast<int>(kernel.size()) - 1 + (step > 1 ? 1 : 0);
  const Lattice lattice{(camera.width_px + step - 1) / step + 2 * margin,
                        (camera.height_px + step - 1) / step + 2 * margin,
                        (0.5F - static_cast<float>(margin)) * static_cast<float>(step), static_cast<float>(step)};
  const auto columns = static_cast<std::size_t>(lattice.columns);
  Planes3 seen(columns * static_cast<std::size_t>(lattice.rows));
  draw(map.radiance, camera, camera_from_map, lattice, seen);
  const std::array<std::vector<float>*, 3> planes = {&seen.red, &seen.green, &seen.blue};
  for (std::vector<float>* plane : planes) blur_plane(plane->data(), lattice.columns, lattice.rows, kernel);

  std::vector<float> mixed(columns + 1);
  for (int y = 0; y < camera.height_px; ++y) {
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(step) - 0.5F + static_cast<float>(margin);
    const auto row = static_cast<std::size_t>(v);
    const float down = v - static_cast<float>(row);
    for (int c = 0; c < 3; ++c) {
      const float* upper = planes[static_cast<std::size_t>(c)]->data() + row * columns;
      const float* lower = down > 0.0F ? upper + columns : upper;
      for (std::size_t i = 0; i < columns; ++i) mixed[i] = gain(c) * (upper[i] + down * (lower[i] - upper[i]));
      float* out = picture.row(y).data() + c;
      if (step == 1) {
        for (int x = 0; x < camera.width_px; ++x) out[3 * x] = mixed[static_cast<std::size_t>(x + margin)];
        continue;
      }
      for (int x = 0; x < camera.width_px; ++x) {
        const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(step) - 0.5F + static_cast<float>(margin);
        const auto left = static_cast<std::size_t>(u);
        out[3 * x] = mixed[left] + (u - static_cast<float>(left)) * (mixed[left + 1] - mixed[left]);
      }
    }
  }
  return picture;
}

}  // namespace faceprobe::synth

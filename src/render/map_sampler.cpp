#include "render/map_sampler.h"

#include "faceprobe/core/angles.h"
#include "render/numbers.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::render {
namespace {

constexpr float kTakenOff = 0.5F;   // of the mean, from every texel
constexpr float kLeastRest = 0.1F;  // of the light, that must be left after it
constexpr float kLeastSine = 1e-6F;

// Which interval of `before`, which rises from 0 to 1, holds x, and how far along it x is.
struct Place {
  int index;
  float share;
};
Place place_of(const float* before, int count, float x) {
  const float* next = std::upper_bound(before + 1, before + count, x);
  const int index = static_cast<int>(next - before) - 1;
  const float width = before[index + 1] - before[index];
  return {index, width > 0 ? std::clamp((x - before[index]) / width, 0.0F, 0x1.fffffep-1F) : 0.5F};
}

// From an even number in [0, 1) to one under the tent from -1 to 1.
float tent(float even) { return even < 0.5F ? std::sqrt(2 * even) - 1 : 1 - std::sqrt(2 * (1 - even)); }

// What each texel is drawn in proportion to: its light less a part of the mean, times the sine that makes it a density over u and v.
struct Weights {
  std::vector<double> of;
  double mean = 0;  // radiance
};
Weights weights_of(const EnvMap& map) {
  Weights out;
  const auto columns = static_cast<std::size_t>(map.width());
  std::vector<double> light(map.radiance().pixel_count());
  std::vector<double> sine(light.size());
  double sum = 0;
  double sines = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float* p = map.radiance().data() + 3 * i;
    light[i] = (static_cast<double>(p[0]) + p[1] + p[2]) / 3;
    sine[i] = std::sin(kPi * (static_cast<double>(i / columns) + 0.5) / map.height());
    sum += light[i] * sine[i];
    sines += sine[i];
  }
  out.mean = sum / sines;
  double rest = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    out.of.push_back(std::max(0.0, light[i] - kTakenOff * out.mean) * sine[i]);
    rest += out.of.back();
  }
  if (rest > kLeastRest * sum) return out;
  for (std::size_t i = 0; i < light.size(); ++i) out.of[i] = sum > 0 ? light[i] * sine[i] : sine[i];
  return out;
}

}  // namespace

MapSampler::MapSampler(const EnvMap& map) : width_(map.width()), height_(map.height()) {
  const auto columns = static_cast<std::size_t>(width_);
  const auto rows = static_cast<std::size_t>(height_);
  const Weights weights = weights_of(map);
  mean_ = static_cast<float>(weights.mean);
  double sum = 0;
  for (const double weight : weights.of) sum += weight;
  row_before_.assign(1, 0.0F);
  double before = 0;
  for (std::size_t y = 0; y < rows; ++y) {
    const double* row = weights.of.data() + y * columns;
    double in_row = 0;
    for (std::size_t x = 0; x < columns; ++x) in_row += row[x];
    double left = 0;
    for (std::size_t x = 0; x < columns; ++x) {
      column_before_.push_back(in_row > 0 ? static_cast<float>(left / in_row)
                                          : static_cast<float>(x) / static_cast<float>(columns));
      left += row[x];
    }
    column_before_.push_back(1.0F);
    before += in_row / sum;
    row_before_.push_back(static_cast<float>(std::min(before, 1.0)));
  }
  row_before_.back() = 1.0F;

  const double area = static_cast<double>(columns * rows);
  texels_.resize(4, static_cast<Eigen::Index>((columns + 2) * (rows + 2)));
  for (int y = -1; y <= height_; ++y) {
    for (int x = -1; x <= width_; ++x) {
      const bool over_pole = y < 0 || y >= height_;
      const int from_x = (x + width_ + (over_pole ? width_ / 2 : 0)) % width_;
      const int from_y = std::clamp(y, 0, height_ - 1);
      auto texel = texels_.col((y + 1) * (width_ + 2) + x + 1);
      texel.head<3>() = Eigen::Map<const Eigen::Vector3f>(map.radiance().pixel(from_x, from_y));
      const double weight = weights.of[static_cast<std::size_t>(from_y) * columns + static_cast<std::size_t>(from_x)];
      texel[3] = static_cast<float>(weight * area / sum);
    }
  }
}

MapSampler::Seen MapSampler::at(const Eigen::Vector3f& direction, float x, float y, float sine) const {
  x += 0.5F;  // of the map with its border
  y += 0.5F;
  const int x0 = std::clamp(static_cast<int>(x), 0, width_);
  const int y0 = std::clamp(static_cast<int>(y), 0, height_);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const int corner = y0 * (width_ + 2) + x0;
  const Eigen::Vector4f value =
      (1 - fy) * ((1 - fx) * texels_.col(corner) + fx * texels_.col(corner + 1)) +
      fy * ((1 - fx) * texels_.col(corner + width_ + 2) + fx * texels_.col(corner + width_ + 3));
  return {direction, value.head<3>(), value[3] / (2 * kPi32 * kPi32 * std::max(kLeastSine, sine))};
}

MapSampler::Seen MapSampler::draw(const Eigen::Vector2f& random) const {
  const Place row = place_of(row_before_.data(), height_ + 1, random.y());
  const float* columns = column_before_.data() + static_cast<std::ptrdiff_t>(row.index) * (width_ + 1);
  const Place column = place_of(columns, width_ + 1, random.x());
  const auto width = static_cast<float>(width_);
  const auto height = static_cast<float>(height_);
  float x = static_cast<float>(column.index) + 0.5F + tent(column.share);
  float y = static_cast<float>(row.index) + 0.5F + tent(row.share);
  if (y < 0 || y > height) {  // over a pole
    y = y < 0 ? -y : 2 * height - y;
    x += width / 2;
  }
  if (x < 0) x += width;
  if (x >= width) x -= width;
  const float theta = kPi32 * y / height;
  const float phi = 2 * kPi32 * (x / width - 0.5F);
  const float sine = std::sin(theta);
  return at({-std::sin(phi) * sine, std::cos(theta), std::cos(phi) * sine}, x, y, sine);
}

MapSampler::Seen MapSampler::look(const Eigen::Vector3f& direction) const {
  const float u = 0.5F - std::atan2(direction.x(), direction.z()) / (2 * kPi32);
  // From both legs of the triangle: the arc cosine alone is coarse near the poles.
  const float sine = std::hypot(direction.x(), direction.z());
  const float v = std::atan2(sine, direction.y()) / kPi32;
  return at(direction, u * static_cast<float>(width_), v * static_cast<float>(height_), sine);
}

}  // namespace faceprobe::render

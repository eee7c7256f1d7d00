#include "face/sampler.h"

#include "face/warp.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::face {
namespace {

// 16 k steps keep the code value within 4e-4, a tenth of a byte, also where the curve is steepest.
constexpr int kEncodeSteps = 1 << 14;

const std::vector<float>& encode_table() {
  static const std::vector<float> table = [] {
    std::vector<float> values(kEncodeSteps + 1);
    for (int i = 0; i <= kEncodeSteps; ++i) {
      values[static_cast<std::size_t>(i)] = srgb_from_linear(static_cast<float>(i) / kEncodeSteps);
    }
    return values;
  }();
  return table;
}

}  // namespace

Eigen::Vector2f SquareRegion::photo_from_unit(float u, float v) const {
  const float dx = (u - 0.5F) * side;
  const float dy = (v - 0.5F) * side;
  return {centre.x() + std::cos(angle) * dx - std::sin(angle) * dy,
          centre.y() + std::sin(angle) * dx + std::cos(angle) * dy};
}

Sampler::Sampler(const Image& linear) : photo_(&linear) {
  constexpr int kSmallest = 64;
  const Image* last = photo_;
  while (std::min(last->width(), last->height()) >= 2 * kSmallest) {
    halved_.push_back(half_size(*last));
    last = &halved_.back();
  }
}

void Sampler::expose(const SquareRegion& region) {
  constexpr int kSize = 64;
  constexpr double kQuantile = 0.98;
  constexpr float kDark = 0.3F;    // below, the networks begin to miss faces
  constexpr float kBright = 1.0F;  // above, HDR pictures clip
  const Image small = warp(region, kSize);
  std::vector<float> levels;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float* pixel = small.pixel(x, y);
      const float level = small.channels() == 3 ? luminance(pixel) : pixel[0];
      if (level > 0) levels.push_back(level);  // what lies outside the photo does not count
    }
  }
  gain_ = 1;
  if (levels.empty()) return;
  const float level = quantile_of(std::move(levels), kQuantile);
  if (level < kDark) gain_ = kDark / level;
  if (level > kBright) gain_ = kBright / level;
}

Image Sampler::warp(const SquareRegion& region, int size) const {
  const float photo_px_per_sample = region.side / static_cast<float>(size);
  // The level at which a sample steps over one to two pixels: bilinear interpolation still sees them all.
  const int wanted = static_cast<int>(std::floor(std::log2(std::max(photo_px_per_sample, 1.0F)) + 0.2F));
  const int depth = std::min(wanted, static_cast<int>(halved_.size()));
  const Image& source = depth > 0 ? halved_[static_cast<std::size_t>(depth - 1)] : *photo_;
  const double shrink = std::ldexp(1.0, -depth);
  const double step = static_cast<double>(photo_px_per_sample) * shrink;
  const double c = std::cos(static_cast<double>(region.angle)) * step;
  const double s = std::sin(static_cast<double>(region.angle)) * step;
  // The warp counts from pixel centres, we from pixel corners.
  const double half = 0.5 * (size - 1);
  const double cx = region.centre.x() * shrink - 0.5;
  const double cy = region.centre.y() * shrink - 0.5;
  Affine source_from_sample;
  source_from_sample << c, -s, cx - (c - s) * half, s, c, cy - (s + c) * half;
  return warp_square(source, source_from_sample, size);
}

void Sampler::sample(const SquareRegion& region, int size, float low, float high, float* out) const {
  const Image sampled = warp(region, size);
  const std::vector<float>& table = encode_table();
  const int channels = sampled.channels();
  const float to_step = gain_ * kEncodeSteps;
  for (int y = 0; y < size; ++y) {
    const float* row = sampled.pixel(0, y);
    for (int x = 0; x < size; ++x, out += 3) {
      for (int k = 0; k < 3; ++k) {
        const float light = row[x * channels + (channels == 3 ? k : 0)] * to_step;
        const auto index = static_cast<std::size_t>(std::clamp(light, 0.0F, static_cast<float>(kEncodeSteps)) + 0.5F);
        out[k] = low + (high - low) * table[index];
      }
    }
  }
}

}  // namespace faceprobe::face

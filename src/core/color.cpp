#include "faceprobe/core/color.h"

#include "faceprobe/core/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe {

namespace {

std::array<float, 256> make_decode_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = linear_from_srgb(static_cast<float>(i) / 255.0F);
  return table;
}

}  // namespace

float linear_from_srgb(float encoded) {
  const float magnitude = std::abs(encoded);
  const float linear = magnitude <= 0.04045F ? magnitude / 12.92F : std::pow((magnitude + 0.055F) / 1.055F, 2.4F);
  return std::copysign(linear, encoded);
}

float srgb_from_linear(float linear) {
  const float magnitude = std::abs(linear);
  const float encoded =
      magnitude <= 0.0031308F ? magnitude * 12.92F : 1.055F * std::pow(magnitude, 1.0F / 2.4F) - 0.055F;
  return std::copysign(encoded, linear);
}

ByteImage encode_srgb(const Image& linear, float gain) {
  // 4096 steps over the square root of the value: finer than half a code value everywhere (checked in tests/core).
  static constexpr int kSteps = 4096;
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> codes(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      const float root = static_cast<float>(i) / static_cast<float>(kSteps);
      codes[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(root * root)));
    }
    return codes;
  }();
  ByteImage encoded(linear.width(), linear.height(), linear.channels());
  std::transform(linear.values().begin(), linear.values().end(), encoded.values().begin(), [gain](float value) {
    const float scaled = value * gain;
    if (!(scaled > 0.0F)) return std::uint8_t{0};  // NaN too
    const float root = std::sqrt(std::min(scaled, 1.0F));
    return table[static_cast<std::size_t>(root * static_cast<float>(kSteps) + 0.5F)];
  });
  return encoded;
}

Image decode_srgb(const ByteImage& encoded) {
  static const std::array<float, 256> table = make_decode_table();
  Image linear(encoded.width(), encoded.height(), encoded.channels());
  std::transform(encoded.values().begin(), encoded.values().end(), linear.values().begin(),
                 [](std::uint8_t code) { return table[code]; });
  return linear;
}

float exposure_for_quantile(const Image& linear, float quantile, float level) {
  std::vector<float> values;
  values.reserve(linear.pixel_count());
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      const float* p = linear.pixel(x, y);
      values.push_back(linear.channels() >= 3 ? luminance(p) : p[0]);
    }
  }
  const float found = quantile_of(std::move(values), std::clamp(quantile, 0.0F, 1.0F));
  return found > 0.0F ? level / found : 1.0F;
}

}  // namespace faceprobe

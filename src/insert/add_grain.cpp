#include "faceprobe/core/color.h"
#include "faceprobe/insert/photo_look.h"
#include "insert/noise_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace faceprobe::insert {
namespace {

// The grain of a picture's channels, with a deviation of 1 in their mean.
class UnitGrain {
 public:
  UnitGrain(const PixelBox& box, const Grain& grain, int channels, std::uint64_t seed)
      : colour_(channels == 3 ? grain.colour : 0), shared_(box, grain.correlation_px, 1, seed, 0),
        tints_(colour_ > 0 ? box : PixelBox{}, grain.colour_correlation_px, 3, seed, 1) {}
  float operator()(int x, int y, int channel) const {
    const float shared = shared_(x, y, 0);
    if (!(colour_ > 0)) return shared;
    // What three independent values have beyond their mean has a mean square of 2/3.
    const float mean = (tints_(x, y, 0) + tints_(x, y, 1) + tints_(x, y, 2)) / 3;
    return shared + colour_ * std::sqrt(1.5F) * (tints_(x, y, channel) - mean);
  }

 private:
  float colour_ = 0;
  NoiseField shared_;
  NoiseField tints_;  // next to nothing where there is no colour
};

void add_to_pixel(const UnitGrain& unit, const Grain& grain, float share, int x, int y, Image& linear) {
  const int channels = linear.channels();
  float* light = linear.pixel(x, y);
  std::array<float, 3> encoded{};
  float brightness = 0;
  for (int c = 0; c < channels; ++c) {
    float& value = encoded.at(static_cast<std::size_t>(c));
    value = srgb_from_linear(light[c] < 0 ? 0.0F : light[c]);  // NaN stays
    brightness += value / static_cast<float>(channels);
  }
  if (!std::isfinite(brightness)) return;
  const float strength = std::min(share, 1.0F) * grain.sigma_at(brightness);
  if (strength == 0) return;  // encoding and back would change bits
  for (int c = 0; c < channels; ++c) {
    const float noisy = encoded.at(static_cast<std::size_t>(c)) + strength * unit(x, y, c);
    light[c] = linear_from_srgb(std::max(noisy, 0.0F));
  }
}

void check(const Image& linear, const Image& where, const Grain& grain) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("add_grain: " + what); };
  if (linear.channels() != 1 && linear.channels() != 3) refuse("the picture must have one or three channels");
  if (!where.same_size(linear) || where.channels() != 1) refuse("`where` must have one channel and the picture's size");
  if (const std::string problem = grain.validate(); !problem.empty()) refuse(problem);
}

}  // namespace

void add_grain(Image& linear, const Image& where, const Grain& grain, std::uint64_t seed) {
  check(linear, where, grain);
  const PixelBox box = box_of(where).value_or(PixelBox{});
  if (box.width() <= 0) return;
  const UnitGrain unit(box, grain, linear.channels(), seed);
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      if (where(x, y) > 0) add_to_pixel(unit, grain, where(x, y), x, y, linear);
    }
  }
}

}  // namespace faceprobe::insert

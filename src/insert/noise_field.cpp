#include "insert/noise_field.h"

#include "faceprobe/core/random.h"
#include "faceprobe/insert/photo_look.h"
#include "insert/gaussian.h"

#include <cstddef>
#include <vector>

namespace faceprobe::insert {
namespace {

// Independent normals, each from its own place, `margin` pixels beyond the box on all sides.
Image white_noise(const PixelBox& box, int margin, int channels, std::uint64_t seed, std::uint64_t purpose) {
  Image noise(box.width() + 2 * margin, box.height() + 2 * margin, channels);
  for (int y = 0; y < noise.height(); ++y) {
    for (int x = 0; x < noise.width(); ++x) {
      const auto place_x = static_cast<std::uint64_t>(std::int64_t{box.left} - margin + x);
      const auto place_y = static_cast<std::uint64_t>(std::int64_t{box.top} - margin + y);
      Random random({seed, purpose, place_x, place_y});
      for (int c = 0; c < channels; ++c) noise(x, y, c) = static_cast<float>(random.normal());
    }
  }
  return noise;
}

}  // namespace

NoiseField::NoiseField(const PixelBox& box, float correlation_px, int channels, std::uint64_t seed,
                       std::uint64_t purpose)
    : box_(box) {
  const std::vector<double> half = gaussian_kernel(static_cast<double>(correlation_px));
  margin_ = static_cast<int>(half.size()) - 1;
  double energy = half[0] * half[0];
  for (int n = 1; n <= margin_; ++n)
    energy += 2 * half[static_cast<std::size_t>(n)] * half[static_cast<std::size_t>(n)];
  gain_ = static_cast<float>(1 / energy);  // its root for each axis
  noise_ = blur(white_noise(box, margin_, channels, seed, purpose), correlation_px);
}

}  // namespace faceprobe::insert

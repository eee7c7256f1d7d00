#include "faceprobe/insert/photo_look.h"
#include "insert/gaussian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

namespace faceprobe::insert {
namespace {

void add_row(std::span<const float> from, float weight, std::span<float> sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * from[i];
}

Image blur_down(const Image& picture, const std::vector<double>& half) {
  Image result(picture.width(), picture.height(), picture.channels());
  const int bottom = picture.height() - 1;
  const int radius = static_cast<int>(half.size()) - 1;
  for (int y = 0; y <= bottom; ++y) {
    for (int k = -radius; k <= radius; ++k) {
      const auto weight = static_cast<float>(half[static_cast<std::size_t>(std::abs(k))]);
      add_row(picture.row(std::clamp(y + k, 0, bottom)), weight, result.row(y));
    }
  }
  return result;
}

// The row with its end pixels repeated, so that a shift along it is a shift of the whole array.
void pad_row(const Image& picture, int y, int radius, std::vector<float>& padded) {
  const auto channels = static_cast<std::size_t>(picture.channels());
  for (int x = -radius; x < picture.width() + radius; ++x) {
    const float* from = picture.pixel(std::clamp(x, 0, picture.width() - 1), y);
    std::copy_n(from, channels, padded.data() + static_cast<std::size_t>(x + radius) * channels);
  }
}

Image blur_across(const Image& picture, const std::vector<double>& half) {
  Image result(picture.width(), picture.height(), picture.channels());
  const int radius = static_cast<int>(half.size()) - 1;
  const auto channels = static_cast<std::size_t>(picture.channels());
  std::vector<float> padded(static_cast<std::size_t>(picture.width() + 2 * radius) * channels);
  for (int y = 0; y < picture.height(); ++y) {
    pad_row(picture, y, radius, padded);
    for (int k = -radius; k <= radius; ++k) {
      const auto weight = static_cast<float>(half[static_cast<std::size_t>(std::abs(k))]);
      const std::span<float> sum = result.row(y);
      add_row({padded.data() + static_cast<std::size_t>(k + radius) * channels, sum.size()}, weight, sum);
    }
  }
  return result;
}

}  // namespace

float blur_to_match(float to_px, float from_px) { return std::sqrt(std::max(0.0F, to_px * to_px - from_px * from_px)); }

Image blur(const Image& picture, float sigma_px) {
  if (!(sigma_px >= 0 && sigma_px <= kLargestSigma)) {
    throw std::invalid_argument("blur: the deviation must be 0 to 64 pixels");
  }
  const std::vector<double> half = gaussian_kernel(static_cast<double>(sigma_px));
  if (picture.empty() || half.size() == 1) return picture;
  return blur_down(blur_across(picture, half), half);
}

}  // namespace faceprobe::insert

// A photo and its flags, resampled into a face's crop.

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/face/geometry.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::face {
namespace {

// Which photo pixels, along one axis, make one crop pixel, and how much of it each: sums to 1 inside the photo, to less
// where the crop pixel hangs over its edge.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

Taps area_taps(double low, double high, int size) {
  Taps taps;
  taps.first = static_cast<int>(std::clamp(std::floor(low + 1e-9), 0.0, static_cast<double>(size)));
  for (int i = taps.first; i < size && i < high - 1e-9; ++i) {
    const double covered = std::min(high, i + 1.0) - std::max(low, static_cast<double>(i));
    if (covered <= 0) break;
    taps.weights.push_back(static_cast<float>(covered / (high - low)));
  }
  return taps;
}

Taps linear_taps(double at, int size) {
  if (at < 0 || at > size) return {};
  const double centre = std::clamp(at - 0.5, 0.0, size - 1.0);
  const int first = std::min(static_cast<int>(centre), std::max(size - 2, 0));
  const auto part = static_cast<float>(centre - first);
  if (size == 1) return {0, {1.0F}};
  return {first, {1.0F - part, part}};
}

std::vector<Taps> axis_taps(double start_px, double scale, int crop_size, int photo_size) {
  std::vector<Taps> taps;
  for (int i = 0; i < crop_size; ++i) {
    if (scale <= 1) {
      taps.push_back(area_taps(start_px + i / scale, start_px + (i + 1) / scale, photo_size));
    } else {
      taps.push_back(linear_taps(start_px + (i + 0.5) / scale, photo_size));
    }
  }
  return taps;
}

void check(const Crop& crop) {
  if (!(crop.scale > 0) || crop.width < 0 || crop.height < 0) {
    throw Error(ExitCode::kUsage, "The crop has a scale of " + std::to_string(crop.scale) + " and a size of " +
                                      std::to_string(crop.width) + " x " + std::to_string(crop.height) +
                                      " px; both must be positive.");
  }
}

}  // namespace

Image crop_picture(const Image& linear, const Crop& crop, int threads) {
  check(crop);
  const int channels = linear.channels();
  Image out(crop.width, crop.height, channels);
  const std::vector<Taps> columns = axis_taps(crop.x_px, crop.scale, crop.width, linear.width());
  const std::vector<Taps> rows = axis_taps(crop.y_px, crop.scale, crop.height, linear.height());
  parallel_for(crop.height, threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const Taps& down = rows[static_cast<std::size_t>(y)];
      for (int x = 0; x < crop.width; ++x) {
        const Taps& across = columns[static_cast<std::size_t>(x)];
        float* sum = out.pixel(x, y);
        for (std::size_t j = 0; j < down.weights.size(); ++j) {
          if (across.weights.empty()) break;
          const float* source = linear.pixel(across.first, down.first + static_cast<int>(j));
          for (const float weight : across.weights) {
            for (int k = 0; k < channels; ++k) sum[k] += down.weights[j] * weight * *source++;
          }
        }
      }
    }
  });
  return out;
}

ByteImage crop_flags(const ByteImage& flags, const Crop& crop) {
  check(crop);
  constexpr std::uint8_t kOutside = 0xFF;
  ByteImage out(crop.width, crop.height, flags.channels(), kOutside);
  const std::vector<Taps> columns = axis_taps(crop.x_px, crop.scale, crop.width, flags.width());
  const std::vector<Taps> rows = axis_taps(crop.y_px, crop.scale, crop.height, flags.height());
  for (int y = 0; y < crop.height; ++y) {
    const Taps& down = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < crop.width; ++x) {
      const Taps& across = columns[static_cast<std::size_t>(x)];
      if (down.weights.empty() || across.weights.empty()) continue;
      for (int k = 0; k < flags.channels(); ++k) {
        std::uint8_t bits = 0;
        for (std::size_t j = 0; j < down.weights.size(); ++j) {
          for (std::size_t i = 0; i < across.weights.size(); ++i) {
            // A bilinear tap of weight 0 is not looked at.
            if (down.weights[j] == 0 || across.weights[i] == 0) continue;
            bits |= flags(across.first + static_cast<int>(i), down.first + static_cast<int>(j), k);
          }
        }
        out(x, y, k) = bits;
      }
    }
  }
  return out;
}

}  // namespace faceprobe::face

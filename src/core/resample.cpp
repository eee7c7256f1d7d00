#include "faceprobe/core/resample.h"

#include <algorithm>
#include <cmath>

namespace faceprobe {
namespace {

// Two neighbours along one axis and what each counts.
struct Pair {
  int first = 0, second = 0;
  float of_first = 0, of_second = 0;
};

Pair pair_at(double at, int size, Outside outside) {
  const double left = std::floor(at - 0.5);
  const auto part = static_cast<float>(at - 0.5 - left);
  const auto inside = [&](double index) { return outside == Outside::kEdge || (index >= 0 && index < size); };
  const auto within = [size](double index) { return static_cast<int>(std::clamp(index, 0.0, size - 1.0)); };
  return {within(left), within(left + 1), inside(left) ? 1 - part : 0.0F, inside(left + 1) ? part : 0.0F};
}

// `each` samples to a pixel of the part.
std::vector<Pair> axis(double start, double scale, int count, int size, int each, Outside outside) {
  std::vector<Pair> pairs;
  pairs.reserve(static_cast<std::size_t>(count) * static_cast<std::size_t>(each));
  for (int i = 0; i < count * each; ++i) pairs.push_back(pair_at(start + (i + 0.5) / each / scale, size, outside));
  return pairs;
}

// Outside the picture `outside`, or its nearest pixel's.
template <class T>
BasicImage<T> each_nearest(const BasicImage<T>& picture, const Window& window, std::optional<T> outside) {
  BasicImage<T> part(window.width, window.height, picture.channels(), outside.value_or(T{}));
  if (picture.empty()) return part;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const auto from_x = static_cast<int>(std::floor(window.left_px + (x + 0.5) / window.scale));
      const auto from_y = static_cast<int>(std::floor(window.top_px + (y + 0.5) / window.scale));
      const int inner_x = std::clamp(from_x, 0, picture.width() - 1);
      const int inner_y = std::clamp(from_y, 0, picture.height() - 1);
      if (outside && (inner_x != from_x || inner_y != from_y)) continue;
      std::copy_n(picture.pixel(inner_x, inner_y), picture.channels(), part.pixel(x, y));
    }
  }
  return part;
}

}  // namespace

Window shrunk(int width, int height, int long_side_px) {
  const double scale = std::min(1.0, static_cast<double>(long_side_px) / std::max(width, height));
  const auto side = [scale](int px) { return std::max(1, static_cast<int>(std::lround(scale * px))); };
  return {.scale = scale, .width = side(width), .height = side(height)};
}

Image resampled(const Image& picture, const Window& window, Outside outside) {
  const int channels = picture.channels();
  Image part(window.width, window.height, channels);
  if (picture.empty()) return part;
  const int each = std::max(1, static_cast<int>(std::ceil(1 / window.scale - 1e-9)));
  const std::vector<Pair> columns = axis(window.left_px, window.scale, window.width, picture.width(), each, outside);
  const std::vector<Pair> rows = axis(window.top_px, window.scale, window.height, picture.height(), each, outside);
  const float share = 1.0F / static_cast<float>(each * each);
  for (int y = 0; y < window.height * each; ++y) {
    const Pair& down = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < window.width * each; ++x) {
      const Pair& across = columns[static_cast<std::size_t>(x)];
      float* sum = part.pixel(x / each, y / each);
      const auto add = [&](int from_x, int from_y, float weight) {
        if (weight == 0) return;
        const float* from = picture.pixel(from_x, from_y);
        for (int c = 0; c < channels; ++c) sum[c] += weight * share * from[c];
      };
      add(across.first, down.first, across.of_first * down.of_first);
      add(across.second, down.first, across.of_second * down.of_first);
      add(across.first, down.second, across.of_first * down.of_second);
      add(across.second, down.second, across.of_second * down.of_second);
    }
  }
  return part;
}

ByteImage resampled(const ByteImage& labels, const Window& window, std::optional<std::uint8_t> outside) {
  return each_nearest(labels, window, outside);
}

Image nearest(const Image& picture, const Window& window) { return each_nearest(picture, window, std::optional(0.0F)); }

}  // namespace faceprobe

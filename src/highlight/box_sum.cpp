#include "highlight/box_sum.h"

#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <vector>

namespace faceprobe::highlight {
namespace {

// `count` values of `channels` each, `stride` floats apart. Sums run in double: what is added and taken away again leaves no trace.
void sum_line(float* values, int count, std::size_t stride, int channels, int radius, std::vector<float>& line) {
  line.resize(static_cast<std::size_t>(count));
  for (int c = 0; c < channels; ++c) {
    const auto at = [&](int i) -> float& {
      return values[static_cast<std::size_t>(i) * stride + static_cast<std::size_t>(c)];
    };
    for (int i = 0; i < count; ++i) line[static_cast<std::size_t>(i)] = at(i);
    double sum = 0;
    for (int i = 0; i < std::min(radius, count); ++i) sum += line[static_cast<std::size_t>(i)];
    for (int i = 0; i < count; ++i) {
      if (i + radius < count) sum += line[static_cast<std::size_t>(i + radius)];
      if (i - radius - 1 >= 0) sum -= line[static_cast<std::size_t>(i - radius - 1)];
      at(i) = static_cast<float>(sum);
    }
  }
}

}  // namespace

void box_sum(Image& image, int radius, int threads) {
  const auto channels = static_cast<std::size_t>(image.channels());
  const std::size_t row = static_cast<std::size_t>(image.width()) * channels;
  parallel_for(image.height(), threads, [&](int first, int last) {
    std::vector<float> line;
    for (int y = first; y < last; ++y)
      sum_line(image.pixel(0, y), image.width(), channels, image.channels(), radius, line);
  });
  parallel_for(image.width(), threads, [&](int first, int last) {
    std::vector<float> line;
    for (int x = first; x < last; ++x) sum_line(image.pixel(x, 0), image.height(), row, image.channels(), radius, line);
  });
}

}  // namespace faceprobe::highlight

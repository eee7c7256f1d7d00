#pragma once
// Internal: a picture as one plane of floats per channel, which is what loops over eight pixels at a time want.

#include <cstddef>
#include <vector>

namespace faceprobe::synth {

struct Planes {
  Planes(int width_px, int height_px, int channel_count)
      : width(width_px), height(height_px), channels(channel_count),
        size(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
        values(size * static_cast<std::size_t>(channel_count)) {}

  float* plane(int c) { return values.data() + static_cast<std::size_t>(c) * size; }
  const float* plane(int c) const { return values.data() + static_cast<std::size_t>(c) * size; }

  int width;
  int height;
  int channels;
  std::size_t size;  // values in a plane
  std::vector<float> values;
};

}  // namespace faceprobe::synth

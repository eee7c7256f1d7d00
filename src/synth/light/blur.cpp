#include "synth/light/blur.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Place of an index beyond the ends of a row whose edges are mirrors, any number of times over.
int mirrored(int i, int count) {
  while (i < 0 || i >= count) i = i < 0 ? -1 - i : 2 * count - 1 - i;
  return i;
}

// I_k(v) / (v / 2)^k * k! by its power series, with exp(-v) and the rest put in by the caller.
double bessel_series(int order, double v) {
  double term = 1;
  double sum = 1;
  for (int m = 1; m < 2000 && term > 1e-17 * sum; ++m) {
    term *= v * v / 4.0 / (static_cast<double>(m) * (m + order));
    sum += term;
  }
  return sum;
}

}  // namespace

std::vector<float> gaussian_kernel(float deviation) {
  assert(deviation >= 0 && deviation <= 24);
  const double v = static_cast<double>(deviation) * static_cast<double>(deviation);
  std::vector<float> kernel;
  double sum = 0;
  for (int k = 0; sum < 1.0 - 1e-4; ++k) {
    const double log_front = k == 0 ? -v : k * std::log(v / 2.0) - std::lgamma(k + 1.0) - v;
    const double weight = std::exp(log_front + std::log(bessel_series(k, v)));
    kernel.push_back(static_cast<float>(weight));
    sum += k == 0 ? weight : 2.0 * weight;
  }
  for (float& weight : kernel) weight = static_cast<float>(weight / sum);
  return kernel;
}

void blur_plane(float* plane, int width, int height, const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  if (radius == 0 || width == 0 || height == 0) return;
  const auto row_size = static_cast<std::size_t>(width);
  std::vector<float> turned(row_size * static_cast<std::size_t>(height));
  std::vector<float> padded(row_size + 2 * static_cast<std::size_t>(radius));
  for (int y = 0; y < height; ++y) {
    const float* in = plane + static_cast<std::size_t>(y) * row_size;
    float* out = turned.data() + static_cast<std::size_t>(y) * row_size;
    std::copy_n(in, width, padded.data() + radius);
    for (int i = 1; i <= radius; ++i) {
      padded[static_cast<std::size_t>(radius - i)] = in[mirrored(-i, width)];
      padded[static_cast<std::size_t>(radius + width - 1 + i)] = in[mirrored(width - 1 + i, width)];
    }
    for (int x = 0; x < width; ++x) out[x] = kernel[0] * in[x];
    for (int k = 1; k <= radius; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      const float* left = padded.data() + radius - k;
      const float* right = padded.data() + radius + k;
      for (int x = 0; x < width; ++x) out[x] += weight * (left[x] + right[x]);
    }
  }
  for (int y = 0; y < height; ++y) {
    const float* middle = turned.data() + static_cast<std::size_t>(y) * row_size;
    float* out = plane + static_cast<std::size_t>(y) * row_size;
    for (int x = 0; x < width; ++x) out[x] = kernel[0] * middle[x];
    for (int k = 1; k <= radius; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k)];
      const float* above = turned.data() + static_cast<std::size_t>(mirrored(y - k, height)) * row_size;
      const float* below = turned.data() + static_cast<std::size_t>(mirrored(y + k, height)) * row_size;
      for (int x = 0; x < width; ++x) out[x] += weight * (above[x] + below[x]);
    }
  }
}

}  // namespace faceprobe::synth

#include "synth/sensor/jpeg.h"

#include "faceprobe/synth/sensor.h"
#include "synth/sensor/jpeg_block.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

// JFIF 1.02's full-range YCbCr, rounded to whole numbers as an encoder stores them.
void to_ycc(Planes& codes) {
  float* r = codes.plane(0);
  float* g = codes.plane(1);
  float* b = codes.plane(2);
  for (std::size_t i = 0; i < codes.size; ++i) {
    const float y = 0.299F * r[i] + 0.587F * g[i] + 0.114F * b[i];
    const float cb = 128.0F - 0.168735892F * r[i] - 0.331264108F * g[i] + 0.5F * b[i];
    const float cr = 128.0F + 0.5F * r[i] - 0.418687589F * g[i] - 0.081312411F * b[i];
    r[i] = std::nearbyint(y);
    g[i] = std::min(255.0F, std::nearbyint(cb));
    b[i] = std::min(255.0F, std::nearbyint(cr));
  }
}

void to_rgb(Planes& codes) {
  float* y = codes.plane(0);
  float* cb = codes.plane(1);
  float* cr = codes.plane(2);
  const auto byte = [](float value) { return std::min(255.0F, std::max(0.0F, value)); };
  for (std::size_t i = 0; i < codes.size; ++i) {
    const float blue = cb[i] - 128.0F;
    const float red = cr[i] - 128.0F;
    const float light = y[i];
    y[i] = byte(light + std::nearbyint(1.402F * red));
    cb[i] = byte(light - std::nearbyint(0.344136286F * blue + 0.714136286F * red));
    cr[i] = byte(light + std::nearbyint(1.772F * blue));
  }
}

// Means of 2 x 2, rounded up and down by turns along a row as libjpeg does, so that no colour drifts.
std::vector<float> halved(const float* plane, int width, int height) {
  const int small_width = (width + 1) / 2;
  const int small_height = (height + 1) / 2;
  std::vector<float> small(static_cast<std::size_t>(small_width) * static_cast<std::size_t>(small_height));
  for (int y = 0; y < small_height; ++y) {
    const float* upper = plane + static_cast<std::size_t>(2 * y) * static_cast<std::size_t>(width);
    const float* lower = 2 * y + 1 < height ? upper + width : upper;
    float* out = small.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(small_width);
    for (int x = 0; x < width / 2; ++x) {
      const float bias = x % 2 == 0 ? 0.25F : 0.5F;
      out[x] = std::floor(0.25F * (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1]) + bias);
    }
    if (width % 2 != 0) {
      const float bias = (width / 2) % 2 == 0 ? 0.25F : 0.5F;
      out[width / 2] = std::floor(0.5F * (upper[width - 1] + lower[width - 1]) + bias);
    }
  }
  return small;
}

// Triangle filter: each sample lies a quarter of the way from its nearest half-size neighbour to the next, along both axes.
void doubled(const std::vector<float>& small, float* plane, int width, int height) {
  const int small_width = (width + 1) / 2;
  const int small_height = (height + 1) / 2;
  std::vector<float> sums(static_cast<std::size_t>(small_width) + 2);
  for (int y = 0; y < height; ++y) {
    const int near = y / 2;
    const int far = std::clamp(y % 2 == 0 ? near - 1 : near + 1, 0, small_height - 1);
    const float* near_row = small.data() + static_cast<std::size_t>(near) * static_cast<std::size_t>(small_width);
    const float* far_row = small.data() + static_cast<std::size_t>(far) * static_cast<std::size_t>(small_width);
    for (int x = 0; x < small_width; ++x) sums[static_cast<std::size_t>(x + 1)] = 3.0F * near_row[x] + far_row[x];
    sums.front() = sums[1];
    sums.back() = sums[static_cast<std::size_t>(small_width)];
    float* out = plane + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width / 2; ++x) {
      const float* s = sums.data() + x + 1;
      out[2 * x] = std::floor((3.0F * s[0] + s[-1] + 8.0F) * 0.0625F);
      out[2 * x + 1] = std::floor((3.0F * s[0] + s[1] + 7.0F) * 0.0625F);
    }
    if (width % 2 != 0) {
      const float* s = sums.data() + small_width;
      out[width - 1] = std::floor((3.0F * s[0] + s[-1] + 8.0F) * 0.0625F);
    }
  }
}

}  // namespace

void jpeg_planes(Planes& codes, int quality, bool chroma_half) {
  if (codes.channels == 3) to_ycc(codes);
  quantise_component(codes.plane(0), codes.width, codes.height, luminance_table(quality));
  if (codes.channels == 1) return;
  const JpegBlock table = chrominance_table(quality);
  for (const int c : {1, 2}) {
    if (chroma_half) {
      std::vector<float> small = halved(codes.plane(c), codes.width, codes.height);
      quantise_component(small.data(), (codes.width + 1) / 2, (codes.height + 1) / 2, table);
      doubled(small, codes.plane(c), codes.width, codes.height);
    } else {
      quantise_component(codes.plane(c), codes.width, codes.height, table);
    }
  }
  to_rgb(codes);
}

ByteImage jpeg_round_trip(const ByteImage& picture, int quality, bool chroma_half) {
  if (picture.channels() != 1 && picture.channels() != 3) {
    throw std::invalid_argument("A JPEG picture has one or three channels.");
  }
  if (quality < 1 || quality > 100) throw std::invalid_argument("A JPEG's quality is 1 to 100.");
  if (picture.empty()) return picture;
  const auto channels = static_cast<std::size_t>(picture.channels());
  Planes codes(picture.width(), picture.height(), picture.channels());
  for (std::size_t c = 0; c < channels; ++c) {
    float* plane = codes.plane(static_cast<int>(c));
    for (std::size_t i = 0; i < codes.size; ++i) plane[i] = picture.data()[channels * i + c];
  }
  jpeg_planes(codes, quality, chroma_half);
  ByteImage out(picture.width(), picture.height(), picture.channels());
  for (std::size_t c = 0; c < channels; ++c) {
    const float* plane = codes.plane(static_cast<int>(c));
    for (std::size_t i = 0; i < codes.size; ++i) {
      out.data()[channels * i + c] = static_cast<std::uint8_t>(static_cast<int>(plane[i]));
    }
  }
  return out;
}

}  // namespace faceprobe::synth

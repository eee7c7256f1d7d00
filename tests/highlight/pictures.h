#pragma once
// Made pictures whose diffuse part and white highlight are known.

#include "faceprobe/highlight/separate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::highlight::testing {

using Colour = std::array<float, 3>;

inline const std::array<Separator, 3> kAll = {Separator::kTan, Separator::kYang, Separator::kShen};

struct Dichromatic {
  Image picture;    // diffuse + highlight
  Image diffuse;    // albedo of the patch times smooth shading
  Image highlight;  // white, one narrow lobe per patch
};

// Side by side patches, `side` pixels each, of the given albedos. Shading falls from 1 to .6 down each patch.
inline Dichromatic dichromatic(std::span<const Colour> albedos, float strength, int side = 40) {
  const int width = side * static_cast<int>(albedos.size());
  Dichromatic scene{Image(width, side, 3), Image(width, side, 3), Image(width, side, 3)};
  const float radius = static_cast<float>(side) / 10;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < width; ++x) {
      const Colour& albedo = albedos[static_cast<std::size_t>(x / side)];
      const float dx = (static_cast<float>(x % side) - 0.5F * static_cast<float>(side)) / radius;
      const float dy = (static_cast<float>(y) - 0.4F * static_cast<float>(side)) / radius;
      const float lobe = strength * std::exp(-0.5F * (dx * dx + dy * dy));
      const float shading = 1 - 0.4F * static_cast<float>(y) / static_cast<float>(side);
      for (int c = 0; c < 3; ++c) {
        scene.diffuse(x, y, c) = 0.6F * shading * albedo[static_cast<std::size_t>(c)];
        scene.highlight(x, y, c) = lobe;
        scene.picture(x, y, c) = scene.diffuse(x, y, c) + lobe;
      }
    }
  }
  return scene;
}

// Three hues of the same saturation: every separator's assumption holds.
inline const std::array<Colour, 3> kThreeHues = {{{0.8F, 0.4F, 0.2F}, {0.2F, 0.8F, 0.4F}, {0.4F, 0.2F, 0.8F}}};

// Flat columns of colour, each `step` pixels wide.
inline Image stripes(std::span<const Colour> colours, int step, int height) {
  Image image(static_cast<int>(colours.size()) * step, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        image(x, y, c) = colours[static_cast<std::size_t>(x / step)][static_cast<std::size_t>(c)];
    }
  }
  return image;
}

inline Image noise(int width, int height, unsigned seed) {
  std::mt19937 generator(seed);
  Image image(width, height, 3);
  for (float& value : image.values()) value = static_cast<float>(generator() >> 8) / static_cast<float>(1 << 24);
  return image;
}

inline double rms(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const double difference = static_cast<double>(a.values()[i]) - b.values()[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.values().size()));
}

inline Image black_like(const Image& image) { return Image(image.width(), image.height(), image.channels()); }

inline double largest(const Image& image) {
  double most = 0;
  for (const float value : image.values()) most = std::max(most, static_cast<double>(value));
  return most;
}

inline Layers run(const Image& picture, Separator separator, const ByteImage& mask = {}, int threads = 2) {
  return separate(picture, mask, {.separator = separator, .threads = threads});
}

inline std::string name_of(Separator separator) { return std::string(separator_name(separator)); }

}  // namespace faceprobe::highlight::testing

#include "faceprobe/core/angles.h"
#include "faceprobe/synth/compose.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Deviation of the Gaussian that spreads light under the skin, metres: of the order of the mean free paths of Jensen et al. 2001
// (skin1: about 1.5, 0.8, 0.5 mm in red, green, blue).
constexpr std::array<float, 3> kSpread = {0.0013F, 0.0007F, 0.0005F};
constexpr float kLeastSpreadPx = 0.2F;  // narrower blurs change nothing

std::vector<float> gaussian(float deviation_px) {
  const int radius = std::max(1, static_cast<int>(std::ceil(2.5F * deviation_px)));
  std::vector<float> taps;
  float sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    taps.push_back(std::exp(-0.5F * static_cast<float>(i * i) / (deviation_px * deviation_px)));
    sum += taps.back();
  }
  for (float& tap : taps) tap /= sum;
  return taps;
}

// Columns and rows swap places, so that both passes run along memory.
void blur_rows_transposed(const std::vector<float>& in, std::vector<float>& out, int width, int height,
                          const std::vector<float>& taps) {
  const int radius = static_cast<int>(taps.size()) / 2;
  std::vector<float> padded(static_cast<std::size_t>(width + 2 * radius), 0.0F);
  std::vector<float> sum(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(y) * width, width, padded.begin() + radius);
    std::ranges::fill(sum, 0.0F);
    for (std::size_t k = 0; k < taps.size(); ++k) {
      const float tap = taps[k];
      const float* source = padded.data() + k;
      for (int x = 0; x < width; ++x) sum[static_cast<std::size_t>(x)] += tap * source[x];
    }
    for (int x = 0; x < width; ++x) {
      out[static_cast<std::size_t>(x) * static_cast<std::size_t>(height) + static_cast<std::size_t>(y)] =
          sum[static_cast<std::size_t>(x)];
    }
  }
}

void blur(std::vector<float>& plane, int width, int height, const std::vector<float>& taps) {
  std::vector<float> turned(plane.size());
  blur_rows_transposed(plane, turned, width, height, taps);
  blur_rows_transposed(turned, plane, height, width, taps);
}

}  // namespace

void scatter_below_surface(const Fragments& fragments, const PinholeCamera& camera, Eigen::MatrixX3f& shading) {
  std::vector<int> skin;
  double depth_m = 0;
  for (int i = 0; i < fragments.count(); ++i) {
    if (fragments.material[static_cast<std::size_t>(i)] != Material::kSkin) continue;
    skin.push_back(i);
    depth_m += static_cast<double>(fragments.depth_m(i));
  }
  if (skin.empty()) return;
  const auto mean_depth_m = static_cast<float>(depth_m / static_cast<double>(skin.size()));
  const std::size_t pixels =
      static_cast<std::size_t>(fragments.width_px) * static_cast<std::size_t>(fragments.height_px);
  for (int c = 0; c < 3; ++c) {
    const float spread_px = kSpread[static_cast<std::size_t>(c)] * camera.focal_px / mean_depth_m;
    if (spread_px < kLeastSpreadPx) continue;
    std::vector<float> light(pixels, 0.0F);
    std::vector<float> weight(pixels, 0.0F);
    for (const int i : skin) {
      const auto pixel = static_cast<std::size_t>(fragments.pixel[static_cast<std::size_t>(i)]);
      const float coverage = fragments.coverage[static_cast<std::size_t>(i)];
      light[pixel] += coverage * shading(i, c);
      weight[pixel] += coverage;
    }
    const std::vector<float> taps = gaussian(spread_px);
    blur(light, fragments.width_px, fragments.height_px, taps);
    blur(weight, fragments.width_px, fragments.height_px, taps);
    for (const int i : skin) {
      const auto pixel = static_cast<std::size_t>(fragments.pixel[static_cast<std::size_t>(i)]);
      if (weight[pixel] > 0) shading(i, c) = light[pixel] / weight[pixel];
    }
  }
}

}  // namespace faceprobe::synth

// Q. Yang, S. Wang, N. Ahuja: Real-time specular highlight removal using bilateral filtering. ECCV 2010.
//
// A white highlight lowers the largest chromaticity of a pixel but leaves lambda, the largest chromaticity of what
// remains once the smallest channel is taken off. Pixels alike in lambda are taken for one surface, and the largest
// chromaticity is spread among them by a bilateral filter guided by lambda until it no longer grows: the diffuse value.

#include "faceprobe/core/parallel.h"
#include "highlight/bilateral_grid.h"
#include "highlight/scene.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace faceprobe::highlight {
namespace {

constexpr float kSpatialShare = 0.25F;  // of the shorter side
constexpr float kMaxSigmasAlong = 64;   // of a strip: bounds the grid for pictures one pixel high
constexpr float kRangeSigma = 0.04F;
constexpr float kGrowth = 0.03F;      // less than this in every pixel ends the iteration
constexpr int kMaxIterations = 100;   // each but the last raises some pixel by kGrowth; photos need a few
constexpr float kLeastLambda = 0.5F;  // of three shares with a zero among them the largest is at least a half

constexpr float kOutside = -2;
constexpr float kGrey = -1;

struct Planes {
  Image lambda;  // kOutside, kGrey (lambda is not defined), or in [1/2, 1]
  Image chroma;  // largest chromaticity
};

Planes read_planes(const Scene& scene) {
  Planes planes{Image(scene.width(), scene.height(), 1, kOutside), Image(scene.width(), scene.height(), 1)};
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < scene.width(); ++x) {
        if (!scene.inside(x, y)) continue;
        const Extremes e = scene.extremes(x, y);
        if (is_grey(e)) {
          planes.lambda(x, y) = kGrey;
          continue;
        }
        planes.lambda(x, y) = std::clamp((e.high - e.low) / (e.total - 3 * e.low), kLeastLambda, 1.0F);
        planes.chroma(x, y) = e.high / e.total;
      }
    }
  });
  return planes;
}

// chroma <- max(chroma, filtered); false, with nothing changed, when no pixel grows by more than kGrowth.
bool grow(Image* chroma, const Image& filtered, int threads) {
  std::atomic<bool> grows = false;
  parallel_for(chroma->height(), threads, [&](int first, int last) {
    for (int y = first; y < last && !grows; ++y) {
      for (int x = 0; x < chroma->width(); ++x) {
        if (filtered(x, y) - (*chroma)(x, y) > kGrowth) grows = true;
      }
    }
  });
  if (!grows) return false;
  parallel_for(chroma->height(), threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < chroma->width(); ++x) (*chroma)(x, y) = std::max((*chroma)(x, y), filtered(x, y));
    }
  });
  return true;
}

}  // namespace

Image yang_highlight(const Scene& scene) {
  Planes planes = read_planes(scene);
  const float shorter = static_cast<float>(std::min(scene.width(), scene.height()));
  const float longer = static_cast<float>(std::max(scene.width(), scene.height()));
  const float spatial = std::max(kSpatialShare * shorter, longer / kMaxSigmasAlong);
  const BilateralGrid grid(planes.lambda, {spatial, kRangeSigma}, scene.threads);
  for (int i = 0; i < kMaxIterations && grow(&planes.chroma, grid.filter(planes.chroma), scene.threads); ++i) {
  }

  Image amount(scene.width(), scene.height(), 1);
  std::vector<float> row_largest(static_cast<std::size_t>(scene.height()));
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      float& largest = row_largest[static_cast<std::size_t>(y)];
      for (int x = 0; x < scene.width(); ++x) {
        if (planes.lambda(x, y) < 0) continue;
        const Extremes e = scene.extremes(x, y);
        amount(x, y) = white_part(e, 3 * planes.chroma(x, y) - 1);
        largest = std::max(largest, amount(x, y));
      }
    }
  });
  // A grey pixel beside coloured ones is most often a highlight that clipped. Its chromaticity says nothing about how
  // much of it is highlight, so the largest amount found elsewhere stands in; a picture all grey keeps an empty layer.
  const float largest = *std::max_element(row_largest.begin(), row_largest.end());
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < scene.width(); ++x) {
        if (planes.lambda(x, y) == kGrey) amount(x, y) = largest;
      }
    }
  });
  return amount;
}

}  // namespace faceprobe::highlight

#include "render/tile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::render {
namespace {

constexpr float kMidGrey = 0.18F;

struct PixelSum {
  Eigen::Vector3f model = Eigen::Vector3f::Zero();
  Eigen::Vector3f shaded = Eigen::Vector3f::Zero();
  Eigen::Vector3f open = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float depth = 0;
  float on_model = 0;
  float on_ground = 0;
  // Of the passes' mean brightness, for the noise.
  float passes = 0, mean = 0, squares = 0;

  void add(const PathSample& sample) {
    if (sample.first == PathSample::First::kModel) {
      model += sample.light;
      normal += sample.normal;
      depth += sample.depth;
      on_model += 1;
    } else if (sample.first == PathSample::First::kGround) {
      shaded += sample.light;
      open += sample.open;
      on_ground += 1;
    }
  }

  // Mean of the pass that has just been added to `before`: the model's light and the shadow's ratio.
  void end_pass(const PixelSum& before, int samples) {
    const float dark = (shaded - before.shaded).mean();
    const float bright = (open - before.open).mean();
    const float ground = bright > 0 ? (on_ground - before.on_ground) * dark / bright : 0;
    const float brightness = ((model - before.model).mean() + ground) / static_cast<float>(samples);
    passes += 1;
    const float step = brightness - mean;
    mean += step / passes;
    squares += step * (brightness - mean);
  }

  // Squared standard error of the brightness, over that of a mid grey or brighter.
  float noise2() const {
    const float level = std::max(kMidGrey, mean);
    return squares / ((passes - 1) * passes * level * level);
  }
};

void write(const PixelSum& sum, float samples, int x, int y, Layers& out) {
  out.samples(x, y) = samples;
  const float coverage = sum.on_model / samples;
  Eigen::Map<Eigen::Vector3f>(out.object.pixel(x, y)) = sum.model / samples;
  out.object(x, y, 3) = coverage;
  out.ground(x, y) = sum.on_ground / samples;
  if (sum.on_model > 0) {
    out.depth(x, y) = sum.depth / sum.on_model;
    const float length = sum.normal.norm();
    if (length > 0) Eigen::Map<Eigen::Vector3f>(out.normal.pixel(x, y)) = sum.normal / length;
  }
  for (int c = 0; c < 3; ++c) {
    if (sum.open[c] > 0) out.shadow(x, y, c) = sum.shaded[c] / sum.open[c];
  }
}

}  // namespace

void render_tile(const PathScene& scene, const RenderOptions& options, int tile_x, int tile_y, Layers& out) {
  const PinholeView& view = scene.options.view;
  const int x0 = tile_x * kTilePx;
  const int y0 = tile_y * kTilePx;
  const int x1 = std::min(x0 + kTilePx, view.width_px);
  const int y1 = std::min(y0 + kTilePx, view.height_px);
  std::array<PixelSum, kTilePx * kTilePx> sums;
  const auto at = [&](int x, int y) -> PixelSum& { return sums[static_cast<std::size_t>((y - y0) * kTilePx + x - x0)]; };
  const auto seed = static_cast<std::uint32_t>(options.seed ^ (options.seed >> 32));
  int taken = 0;
  while (taken < options.samples) {
    const int pass = std::min(options.least_samples, options.samples - taken);
    bool seen = false;
    float noise2 = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::uint32_t key = hashed(hashed(seed, static_cast<std::uint32_t>(x)), static_cast<std::uint32_t>(y));
        PixelSum& sum = at(x, y);
        const PixelSum before = sum;
        for (int s = taken; s < taken + pass; ++s) {
          SobolSampler random(key, static_cast<std::uint32_t>(s));
          const Eigen::Vector2f place = random.pair();
          const Eigen::Vector3f ray = view.ray(x + static_cast<double>(place.x()), y + static_cast<double>(place.y()));
          const PathSample sample = trace_path(scene, ray.normalized(), random);
          sum.add(sample);
          seen = seen || sample.first != PathSample::First::kNothing;
        }
        sum.end_pass(before, pass);
        if (sum.passes > 1) noise2 += sum.noise2();
      }
    }
    taken += pass;
    if (!seen) break;  // an empty corner of the picture
    if (options.noise > 0 && taken > options.least_samples &&
        noise2 < options.noise * options.noise * static_cast<float>((x1 - x0) * (y1 - y0)))
      break;
  }
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) write(at(x, y), static_cast<float>(taken), x, y, out);
  }
}

}  // namespace faceprobe::render

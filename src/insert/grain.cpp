// Sigma is that of blocks which are flat but for the grain, found per level of brightness as the densest place at the low end of
// the blocks' variances, after slow shading is taken out of each: block-based estimation in the sense of Pyatykh, Hesser & Zheng 2013
// ("Image noise level estimation by principal component analysis", TIP 22) and its predecessors. A high-pass filter such as
// Immerkaer's (1996, CVIU 64) would read soft grain, what JPEG and demosaicing leave, as too weak.
#include "faceprobe/insert/photo_look.h"
#include "insert/block_fit.h"
#include "insert/block_noise.h"
#include "insert/grain_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::insert {
namespace {

constexpr std::size_t kEnoughBlocks = 12;
constexpr double kNoGrain = 1e-10;     // what encoding in float leaves of a constant
constexpr double kLowShare = 0.05;     // a photo has at least this share of flat blocks
constexpr double kFlatVariance = 1.4;  // variances of flat blocks stay below this multiple of their median

using Blocks = std::vector<BlockNoise>;

double variance_at(const Blocks& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))].shared.variance;
}

// Blocks without any variance were painted, not photographed; unless they are most of the level.
void drop_painted(Blocks& sorted) {
  const auto grainy =
      std::find_if(sorted.begin(), sorted.end(), [](const auto& b) { return b.shared.variance > kNoGrain; });
  if (2 * (grainy - sorted.begin()) < std::ssize(sorted)) sorted.erase(sorted.begin(), grainy);
}

// Keeps the blocks that are flat but for the grain; their median variance is the grain's.
Blocks flat_blocks(Blocks blocks) {
  const auto by_variance = [](const BlockNoise& a, const BlockNoise& b) {
    return a.shared.variance < b.shared.variance;
  };
  std::stable_sort(blocks.begin(), blocks.end(), by_variance);
  drop_painted(blocks);
  double variance = variance_at(blocks, kLowShare);
  Blocks flat;
  for (int round = 0; round < 3; ++round) {
    const auto is_flat = [&](const BlockNoise& b) { return b.shared.variance <= kFlatVariance * variance; };
    flat.assign(blocks.begin(), std::partition_point(blocks.begin(), blocks.end(), is_flat));
    variance = variance_at(flat, 0.5);
  }
  return flat;
}

float sigma_of(const Blocks& flat) {
  const double variance = variance_at(flat, 0.5);
  return variance > kNoGrain ? static_cast<float>(std::sqrt(variance)) : 0.0F;
}

// What the fit took from soft grain is given back to its sigma.
void describe(const Blocks& flat, const BlockFit& fit, Grain& grain) {
  Moments shared;
  Moments colour;
  for (const BlockNoise& block : flat) {
    shared.variance += block.shared.variance;
    shared.covariance += block.shared.covariance;
    colour.variance += block.colour.variance;
    colour.covariance += block.colour.covariance;
  }
  const double least = kNoGrain * static_cast<double>(flat.size());
  if (!(shared.variance > least)) return;
  grain.correlation_px = correlation_of(fit, shared.covariance / shared.variance);
  const double kept = fit.expected(grain.correlation_px).variance;
  for (float& sigma : grain.sigma) sigma = std::min(1.0F, sigma / static_cast<float>(std::sqrt(kept)));
  if (!(colour.variance > least)) return;
  grain.colour_correlation_px = correlation_of(fit, colour.covariance / colour.variance);
  const double colour_kept = fit.expected(grain.colour_correlation_px).variance;
  const double ratio = std::sqrt(colour.variance / colour_kept * kept / shared.variance);
  grain.colour = std::min(Grain::kMostColour, static_cast<float>(ratio));
}

// The flat blocks of each level; of a picture too small for levels all of them at the first.
std::array<Blocks, kLevels> flat_by_level(const Blocks& blocks) {
  std::array<Blocks, kLevels> levels;
  for (const BlockNoise& block : blocks) levels[level_of(block.brightness)].push_back(block);
  bool any = false;
  for (Blocks& level : levels) {
    level = level.size() < kEnoughBlocks ? Blocks{} : flat_blocks(std::move(level));
    any = any || !level.empty();
  }
  if (!any) levels[0] = flat_blocks(blocks);
  return levels;
}

}  // namespace

Grain estimate_grain(const Image& linear) {
  if (linear.channels() != 1 && linear.channels() != 3) {
    throw std::invalid_argument("estimate_grain: the picture must have one or three channels");
  }
  const BlockFit fit;
  const Blocks blocks = measure_blocks(linear, fit);
  if (blocks.empty()) return {};
  const std::array<Blocks, kLevels> levels = flat_by_level(blocks);
  KnownSigma known;
  for (std::size_t i = 0; i < kLevels; ++i) {
    if (!levels[i].empty()) known[i] = sigma_of(levels[i]);
  }
  known = held(known);
  Blocks flat;
  for (std::size_t i = 0; i < kLevels; ++i) {
    const double most = kFlatVariance * std::pow(static_cast<double>(known[i].value_or(0)), 2);
    std::copy_if(levels[i].begin(), levels[i].end(), std::back_inserter(flat),
                 [most](const BlockNoise& block) { return block.shared.variance <= most; });
  }
  Grain grain{.sigma = filled(known)};
  describe(flat, fit, grain);
  return grain;
}

}  // namespace faceprobe::insert

#include "highlight/chroma_clusters.h"

#include "faceprobe/core/parallel.h"
#include "highlight/fixed_point.h"

#include <algorithm>
#include <cstdint>
#include <mutex>

namespace faceprobe::highlight {
namespace {

constexpr float kClusterRadius = 0.3F;  // L1 distance of pseudo chromaticities

// First candidate at or after `from` that is not within the radius of any leader; the map's size when there is none.
std::size_t next_leader(const Scene& scene, const ChromaMap& chroma, const std::vector<PseudoChroma>& leaders,
                        std::size_t from) {
  const auto covered = [&](const PseudoChroma& c) {
    return std::any_of(leaders.begin(), leaders.end(),
                       [&](const PseudoChroma& leader) { return distance(c, leader) < kClusterRadius; });
  };
  std::size_t best = chroma.size();
  std::mutex guard;
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (std::size_t i = std::max(from, row_start(scene, first)); i < row_start(scene, last); ++i) {
      if (!chroma[i].candidate() || covered(chroma[i])) continue;
      const std::lock_guard lock(guard);
      best = std::min(best, i);
      return;
    }
  });
  return best;
}

std::vector<PseudoChroma> find_leaders(const Scene& scene, const ChromaMap& chroma) {
  std::vector<PseudoChroma> leaders;
  for (std::size_t i = next_leader(scene, chroma, leaders, 0); i < chroma.size();
       i = next_leader(scene, chroma, leaders, i + 1)) {
    leaders.push_back(chroma[i]);
  }
  return leaders;
}

std::size_t first_covering(const std::vector<PseudoChroma>& leaders, const PseudoChroma& c) {
  std::size_t k = 0;
  while (distance(c, leaders[k]) >= kClusterRadius) ++k;
  return k;
}

std::vector<PseudoChroma> cluster_means(const Scene& scene, const ChromaMap& chroma,
                                        const std::vector<PseudoChroma>& leaders) {
  struct Sum {
    std::int64_t low = 0;
    std::int64_t high = 0;
    std::int64_t count = 0;
  };
  std::vector<Sum> sums(leaders.size());
  std::mutex guard;
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    std::vector<Sum> local(leaders.size());
    for (std::size_t i = row_start(scene, first); i < row_start(scene, last); ++i) {
      if (!chroma[i].candidate()) continue;
      Sum& sum = local[first_covering(leaders, chroma[i])];
      sum.low += fixed(chroma[i].low);
      sum.high += fixed(chroma[i].high);
      ++sum.count;
    }
    const std::lock_guard lock(guard);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k].low += local[k].low;
      sums[k].high += local[k].high;
      sums[k].count += local[k].count;
    }
  });
  std::vector<PseudoChroma> means;
  for (const Sum& sum : sums) {  // a leader covers itself, so no count is 0
    const double scale = 1 / (kFixedPoint * static_cast<double>(sum.count));
    means.push_back({static_cast<float>(static_cast<double>(sum.low) * scale),
                     static_cast<float>(static_cast<double>(sum.high) * scale)});
  }
  return means;
}

}  // namespace

std::vector<PseudoChroma> cluster_centres(const Scene& scene, const ChromaMap& chroma) {
  return cluster_means(scene, chroma, find_leaders(scene, chroma));
}

}  // namespace faceprobe::highlight

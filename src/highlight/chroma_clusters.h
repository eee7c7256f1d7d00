#pragma once
// The clusters of Shen & Zheng 2013: pixels of one surface colour, told by a chromaticity that highlights hardly move.

#include "highlight/scene.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace faceprobe::highlight {

// Smallest and largest component of the pseudo chromaticity; the middle one follows from them.
struct PseudoChroma {
  float low = -1;  // -1: not a candidate, its smallest channel is below the mean
  float high = 0;
  bool candidate() const { return low >= 0; }
};

inline float distance(const PseudoChroma& a, const PseudoChroma& b) {
  return std::abs(a.low - b.low) + std::abs(a.high - b.high);
}

using ChromaMap = std::vector<PseudoChroma>;  // row-major, one per pixel

inline std::size_t row_start(const Scene& scene, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width());
}

// Cluster centres. Scan order decides where clusters start: the first candidate that no cluster covers
// is the seed of the next one. Empty when there is no candidate.
std::vector<PseudoChroma> cluster_centres(const Scene& scene, const ChromaMap& chroma);

// Index of the centre nearest to c; centres must not be empty.
inline std::size_t nearest(const std::vector<PseudoChroma>& centres, const PseudoChroma& c) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < centres.size(); ++k) {
    if (distance(c, centres[k]) < distance(c, centres[best])) best = k;
  }
  return best;
}

}  // namespace faceprobe::highlight

// H.-L. Shen, Z.-H. Zheng: Real-time highlight removal using intensity ratio. Applied Optics 52(19), 2013.
//
// For a surface of one colour high / (high - low) is the same in every diffuse pixel, and a white highlight raises it:
// the intensity ratio. The median over the pixels of one colour is taken for the diffuse value; colours are told apart
// by the pseudo chromaticity, that of the picture with the smallest channel levelled to its mean.

#include "faceprobe/core/parallel.h"
#include "highlight/chroma_clusters.h"
#include "highlight/fixed_point.h"
#include "highlight/scene.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <vector>

namespace faceprobe::highlight {
namespace {

// Mean of the smallest channel inside the mask: the paper's threshold between dark, noisy pixels and candidates.
float mean_low(const Scene& scene) {
  struct RowSum {
    double low = 0;
    int count = 0;
  };
  // One sum per row, added in order: any thread count gives the same mean.
  std::vector<RowSum> rows(static_cast<std::size_t>(scene.height()));
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      RowSum sum;
      for (int x = 0; x < scene.width(); ++x) {
        if (!scene.inside(x, y)) continue;
        sum.low += scene.extremes(x, y).low;
        ++sum.count;
      }
      rows[static_cast<std::size_t>(y)] = sum;
    }
  });
  double low = 0;
  double count = 0;
  for (const RowSum& row : rows) {
    low += row.low;
    count += row.count;
  }
  return count > 0 ? static_cast<float>(low / count) : 0.0F;
}

ChromaMap pseudo_chromaticities(const Scene& scene, float level) {
  ChromaMap chroma(scene.linear.pixel_count());
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      PseudoChroma* row = chroma.data() + row_start(scene, y);
      for (int x = 0; x < scene.width(); ++x) {
        if (!scene.inside(x, y)) continue;
        const Extremes e = scene.extremes(x, y);
        if (e.low <= level) continue;
        const float total = e.total - 3 * e.low + 3 * level;
        row[x] = {level / total, (e.high - e.low + level) / total};
      }
    }
  });
  return chroma;
}

// The diffuse high / (high - low) of each cluster, 0 where no pixel has colour enough to tell.
std::vector<float> cluster_ratios(const Scene& scene, const ChromaMap& chroma, const std::vector<PseudoChroma>& centres,
                                  float level) {
  std::vector<MedianHistogram> histograms(centres.size());
  std::mutex guard;
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    std::vector<MedianHistogram> local(centres.size());
    for (int y = first; y < last; ++y) {
      const PseudoChroma* row = chroma.data() + row_start(scene, y);
      for (int x = 0; x < scene.width(); ++x) {
        if (!row[x].candidate()) continue;
        const Extremes e = scene.extremes(x, y);
        const float range = e.high - e.low;
        if (range > level && !is_grey(e)) local[nearest(centres, row[x])].add(range / e.high);
      }
    }
    const std::lock_guard lock(guard);
    for (std::size_t k = 0; k < centres.size(); ++k) histograms[k].add(local[k]);
  });
  std::vector<float> ratios;
  for (const MedianHistogram& histogram : histograms) {
    const double median = histogram.median();  // of the reciprocal, whose order is the reverse: the median stays
    ratios.push_back(median > 0 ? static_cast<float>(1 / median) : 0.0F);
  }
  return ratios;
}

}  // namespace

Image shen_highlight(const Scene& scene) {
  Image amount(scene.width(), scene.height(), 1);
  const float level = mean_low(scene);
  const ChromaMap chroma = pseudo_chromaticities(scene, level);
  const std::vector<PseudoChroma> centres = cluster_centres(scene, chroma);
  if (centres.empty()) return amount;
  const std::vector<float> ratios = cluster_ratios(scene, chroma, centres, level);

  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const PseudoChroma* row = chroma.data() + row_start(scene, y);
      for (int x = 0; x < scene.width(); ++x) {
        if (!row[x].candidate()) continue;
        const float ratio = ratios[nearest(centres, row[x])];
        if (ratio <= 0) continue;
        const Extremes e = scene.extremes(x, y);
        amount(x, y) = std::max(0.0F, e.high - ratio * (e.high - e.low));
      }
    }
  });
  return amount;
}

}  // namespace faceprobe::highlight

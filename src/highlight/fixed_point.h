#pragma once
// Sums and medians that come out the same in whatever order threads add their parts: whole numbers instead of floats.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace faceprobe::highlight {

// For values in [0, 1]: 2^33 of them fit into a sum.
inline constexpr double kFixedPoint = 1 << 30;
inline std::int64_t fixed(double value) { return std::llround(value * kFixedPoint); }

// Median of values in [0, 1]; the answer is the mean of the bin it falls in, exact where all values are equal.
class MedianHistogram {
 public:
  MedianHistogram() : counts_(kBins), sums_(kBins) {}
  void add(float value) {
    const auto bin = static_cast<std::size_t>(std::min(static_cast<int>(value * kBins), kBins - 1));
    ++counts_[bin];
    sums_[bin] += fixed(value);
  }
  void add(const MedianHistogram& other) {
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
      counts_[bin] += other.counts_[bin];
      sums_[bin] += other.sums_[bin];
    }
  }
  // 0 when nothing was added.
  double median() const {
    std::int64_t total = 0;
    for (const std::int64_t count : counts_) total += count;
    std::int64_t seen = 0;
    for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
      seen += counts_[bin];
      if (2 * seen > total) return static_cast<double>(sums_[bin]) / kFixedPoint / static_cast<double>(counts_[bin]);
    }
    return 0;
  }

 private:
  static constexpr int kBins = 8192;
  std::vector<std::int64_t> counts_;
  std::vector<std::int64_t> sums_;
};

}  // namespace faceprobe::highlight

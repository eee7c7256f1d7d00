#include "faceprobe/eval/statistics.h"

#include "faceprobe/core/random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double mean_of(std::span<const double> values) {
  if (values.empty()) return kNothing;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double quantile_of_sorted(std::span<const double> sorted, double p) {
  if (sorted.empty()) return kNothing;
  const double rank = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::pair<double, double> bootstrap_interval(std::span<const double> values, const Bootstrap& bootstrap,
                                             const std::function<double(std::span<double>)>& of) {
  if (bootstrap.resamples < 1) throw std::invalid_argument("bootstrap_interval: resamples must be at least 1");
  if (values.size() < 2) return {kNothing, kNothing};
  Random random({bootstrap.seed});
  const int count = static_cast<int>(values.size());
  std::vector<double> found(static_cast<std::size_t>(bootstrap.resamples));
  std::vector<double> drawn(values.size());
  for (double& statistic : found) {
    for (double& value : drawn) value = values[static_cast<std::size_t>(random.below(count))];
    statistic = of(drawn);
  }
  std::sort(found.begin(), found.end());
  return {quantile_of_sorted(found, 0.025), quantile_of_sorted(found, 0.975)};
}

Summary summarize(std::span<const double> values, const Bootstrap& bootstrap) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  // Sorted first, so that the draws do not depend on the order in which values came.
  std::sort(sorted.begin(), sorted.end());

  const auto [low, high] = bootstrap_interval(sorted, bootstrap, [](std::span<double> drawn) { return mean_of(drawn); });
  return {.count = sorted.size(),
          .missing = values.size() - sorted.size(),
          .mean = mean_of(sorted),
          .median = quantile_of_sorted(sorted, 0.5),
          .p90 = quantile_of_sorted(sorted, 0.9),
          .mean_low = low,
          .mean_high = high};
}

Histogram histogram(std::span<const double> values, double low, double high, int bins) {
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high) || bins < 1) {
    throw std::invalid_argument("histogram: needs low < high, both finite, and at least one bin");
  }
  Histogram out{low, high, std::vector<std::size_t>(static_cast<std::size_t>(bins)), 0, 0};
  for (const double value : values) {
    if (value < low) {
      ++out.below;
    } else if (value > high) {
      ++out.above;
    } else if (!std::isnan(value)) {
      const int bin = static_cast<int>((value - low) / (high - low) * bins);
      ++out.counts[static_cast<std::size_t>(std::min(bin, bins - 1))];
    }
  }
  return out;
}

}  // namespace faceprobe::eval

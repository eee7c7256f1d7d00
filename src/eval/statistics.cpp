#include "faceprobe/eval/statistics.h"

#include "faceprobe/core/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double mean_of(std::span<const double> values) {
  if (values.empty()) return kNothing;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

ValuesByPerson everybody_once(std::span<const double> values) {
  ValuesByPerson people;
  people.reserve(values.size());
  for (const double value : values) people.push_back({value});
  return people;
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
  return cluster_interval(everybody_once(values), bootstrap, of);
}

ValuesByPerson values_by_person(std::span<const double> values, std::span<const std::string> persons) {
  if (values.size() != persons.size()) {
    throw std::invalid_argument("values_by_person: there are " + std::to_string(persons.size()) + " names for " +
                                std::to_string(values.size()) + " values");
  }
  ValuesByPerson people;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const auto [known, is_new] = place.emplace(persons[i], people.size());
    if (is_new || persons[i].empty()) {
      people.push_back({values[i]});
    } else {
      people[known->second].push_back(values[i]);
    }
  }
  // Sorted, so that the draws do not depend on the order in which values came.
  for (std::vector<double>& of_one : people) std::sort(of_one.begin(), of_one.end());
  std::sort(people.begin(), people.end());
  return people;
}

std::pair<double, double> cluster_interval(const ValuesByPerson& people, const Bootstrap& bootstrap,
                                           const std::function<double(std::span<double>)>& of) {
  if (bootstrap.resamples < 1) throw std::invalid_argument("bootstrap: resamples must be at least 1");
  if (people.size() < 2) return {kNothing, kNothing};
  Random random({bootstrap.seed});
  const int count = static_cast<int>(people.size());
  std::vector<double> found(static_cast<std::size_t>(bootstrap.resamples));
  std::vector<double> drawn;
  for (double& statistic : found) {
    drawn.clear();
    for (int i = 0; i < count; ++i) {
      const std::vector<double>& one = people[static_cast<std::size_t>(random.below(count))];
      drawn.insert(drawn.end(), one.begin(), one.end());
    }
    statistic = of(drawn);
  }
  std::sort(found.begin(), found.end());
  return {quantile_of_sorted(found, 0.025), quantile_of_sorted(found, 0.975)};
}

Summary summarize(std::span<const double> values, const Bootstrap& bootstrap) {
  return summarize(values, std::vector<std::string>(values.size()), bootstrap);
}

Summary summarize(std::span<const double> values, std::span<const std::string> persons, const Bootstrap& bootstrap) {
  const ValuesByPerson people = values_by_person(values, persons);
  std::vector<double> sorted;
  for (const std::vector<double>& one : people) sorted.insert(sorted.end(), one.begin(), one.end());
  std::sort(sorted.begin(), sorted.end());
  const auto [low, high] = cluster_interval(people, bootstrap, [](std::span<double> drawn) { return mean_of(drawn); });
  return {.count = sorted.size(),
          .people = people.size(),
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

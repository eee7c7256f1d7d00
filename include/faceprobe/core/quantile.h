#pragma once
// Medians and quantiles as levels that a few odd values do not move: always one of the values, nothing is interpolated. Not for tables of
// measurements, whose quantiles lie between two ranks: eval/statistics.h.
//
//   const float skin = upper_median_of(std::move(levels));
//   const float bright = quantile_of(layer, 0.99);  // a copy: `layer` keeps its order

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <vector>

namespace faceprobe {

// The value of rank `share` (#values - 1), rounded down; ranks count from 0, the smallest, and `share` lies in [0, 1]. 0 for an empty list. No
// value may be NaN. The rank is reckoned in the type of `share`: 0.9F is a little less than .9, but of eleven values it is rank 9 too.
template <class T, std::floating_point Share>
T quantile_of(std::vector<T> values, Share share) {
  if (values.empty()) return T{};
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  // A float can round the number of values up.
  const auto rank = std::min(last, static_cast<std::ptrdiff_t>(share * static_cast<Share>(last)));
  const auto at = values.begin() + rank;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The middle value; of an even number the larger of the middle two, where quantile_of(values, 0.5) is the smaller. 0 for an empty list. No
// value may be NaN.
template <class T>
T upper_median_of(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace faceprobe

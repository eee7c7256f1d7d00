#pragma once
// Whether counts are what is expected of them.

#include <cmath>
#include <vector>

namespace faceprobe::render::testing {

// Probability of a chi-square sum at least this large (Wilson & Hilferty 1931; good to .005 from five degrees of freedom on). Bins that
// expect fewer than five are taken together. 0 when something is in a bin that expects nothing.
inline double chi_square_p(const std::vector<double>& counts, const std::vector<double>& expected) {
  double sum = 0;
  double rest = 0;
  double rest_expected = 0;
  int bins = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] <= 0 && counts[i] > 0) return 0;
    if (expected[i] < 5) {
      rest += counts[i];
      rest_expected += expected[i];
      continue;
    }
    sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    ++bins;
  }
  if (rest_expected > 0) {
    sum += (rest - rest_expected) * (rest - rest_expected) / rest_expected;
    ++bins;
  }
  if (bins < 2) return 1;  // all in one place, as expected
  const double k = bins - 1;
  const double z = (std::cbrt(sum / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

}  // namespace faceprobe::render::testing

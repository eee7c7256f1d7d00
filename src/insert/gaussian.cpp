#include "insert/gaussian.h"

#include <cmath>
#include <cstddef>

namespace faceprobe::insert {
namespace {

// Below this variance no pixel changes by as much as the rounding of a float photo's shadows.
constexpr double kNoVariance = 1e-6;

}  // namespace

std::vector<double> gaussian_kernel(double sigma_px) {
  const double variance = sigma_px * sigma_px;
  if (variance < kNoVariance) return {1};
  const auto radius = static_cast<std::size_t>(std::ceil(5 * sigma_px)) + 3;
  // Miller's backward recurrence, I_(n-1) = I_(n+1) + 2 n / t I_n, from beyond the radius where any start does.
  std::vector<double> half(radius + 1);
  double above = 0;
  double here = 1e-200;
  double sum = 0;
  for (std::size_t n = radius + 8; n > 0; --n) {
    if (n <= radius) sum += 2 * (half[n] = here);
    const double below = above + 2 * static_cast<double>(n) / variance * here;
    above = here;
    here = below;
  }
  half[0] = here;
  for (double& weight : half) weight /= sum + here;
  return half;
}

}  // namespace faceprobe::insert

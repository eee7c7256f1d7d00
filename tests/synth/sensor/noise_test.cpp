#include "synth/sensor/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace faceprobe::synth {
namespace {

constexpr std::size_t kCount = 1U << 20U;

std::vector<float> normals(std::uint64_t key, std::size_t count = kCount) {
  std::vector<float> values(count);
  fill_normals(values.data(), count, key);
  return values;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i + lag < a.size(); ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i + lag]);
  return sum / static_cast<double>(a.size() - lag);
}

TEST(Noise, MomentsOfTheNormalDistribution) {
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (const float value : normals(42)) {
    const double x = value;
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
  }
  // Standard errors at 2^20 draws: sqrt(1, 2, 15, 96 / n) = .001, .0014, .0038, .0096. Four of them.
  const double n = static_cast<double>(kCount);
  EXPECT_NEAR(m1 / n, 0, 0.004);
  EXPECT_NEAR(m2 / n, 1, 0.0055);
  EXPECT_NEAR(m3 / n, 0, 0.015);
  EXPECT_NEAR(m4 / n, 3, 0.038);
}

TEST(Noise, DistributionFunctionIsTheNormalOne) {
  std::vector<float> values = normals(7);
  std::sort(values.begin(), values.end());
  double worst = 0;  // Kolmogorov & Smirnov's distance
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = 0.5 * std::erfc(-static_cast<double>(values[i]) / std::sqrt(2.0));
    worst = std::max(worst, std::abs(expected - (static_cast<double>(i) + 0.5) / static_cast<double>(kCount)));
  }
  EXPECT_LT(worst, 1.95 / std::sqrt(static_cast<double>(kCount)));  // exceeded once in a thousand
  EXPECT_GT(values.back(), 4.0F);                                   // one in 31,574 is beyond 4
  EXPECT_LT(values.back(), 5.9F);
}

TEST(Noise, NeighboursChannelsAndKeysAreUnrelated) {
  const std::vector<float> a = normals(1);
  const double bound = 4.5 / std::sqrt(static_cast<double>(kCount));
  for (const std::size_t lag : {1U, 2U, 63U, 64U, 65U, 128U, 256U, 16384U})
    EXPECT_LT(std::abs(correlation(a, a, lag)), bound) << lag;
  for (const std::uint64_t other : {2ULL, 3ULL, 1ULL << 32U, (1ULL << 32U) + 1ULL, ~1ULL}) {
    EXPECT_LT(std::abs(correlation(a, normals(other), 0)), bound) << other;
  }
}

TEST(Noise, AValueDependsOnItsPlaceAndKeyOnly) {
  const std::vector<float> long_run = normals(9, 1000);
  const std::vector<float> short_run = normals(9, 333);
  EXPECT_TRUE(std::equal(short_run.begin(), short_run.end(), long_run.begin()));
}

}  // namespace
}  // namespace faceprobe::synth

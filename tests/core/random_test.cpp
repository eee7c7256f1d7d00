#include "faceprobe/core/random.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace faceprobe {
namespace {

constexpr int kDraws = 200000;

// Chi-square of counts against equal shares.
template <class Counts>
double chi_square(const Counts& counts, double expected) {
  double sum = 0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// Data sets are named by their seed, so these numbers may never change. They come from a second implementation, in whole
// numbers of any length, of what the header describes.
TEST(Random, SequenceIsWrittenInStone) {
  Random random({20240501, 17});
  const std::array<std::uint32_t, 4> expected = {2421720070U, 375477964U, 1994229002U, 175747545U};
  for (const std::uint32_t bits : expected) EXPECT_EQ(random.bits(), bits);
  Random split = Random({20240501, 17}).split(3);
  EXPECT_EQ(split.bits(), 207592265U);
  EXPECT_EQ(split.uniform(), 0.9385432891847056);
}

TEST(Random, UniformIsUniform) {
  Random random({1});
  std::array<int, 64> counts{};
  std::array<int, 64> pairs{};  // of neighbours, 8 x 8
  double last = random.uniform();
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    ++counts[static_cast<std::size_t>(value * 64)];
    ++pairs[static_cast<std::size_t>(value * 8) * 8 + static_cast<std::size_t>(last * 8)];
    last = value;
  }
  // 63 degrees of freedom: 112 is passed once in ten thousand draws of the key, 25 is missed as often.
  for (const auto& found : {counts, pairs}) {
    EXPECT_LT(chi_square(found, kDraws / 64.0), 112);
    EXPECT_GT(chi_square(found, kDraws / 64.0), 25);
  }
}

TEST(Random, EveryBitIsFair) {
  Random random({2, 3});
  std::array<int, 32> ones{};
  for (int i = 0; i < kDraws; ++i) {
    const std::uint32_t bits = random.bits();
    for (std::size_t b = 0; b < 32; ++b) ones[b] += static_cast<int>((bits >> b) & 1U);
  }
  // Four and a half standard errors of sqrt(n) / 2.
  for (const int count : ones) EXPECT_NEAR(count, kDraws / 2, 4.5 * 0.5 * std::sqrt(kDraws));
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  Random random({4});
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    m1 += x / kDraws;
    m2 += x * x / kDraws;
    m3 += x * x * x / kDraws;
    m4 += x * x * x * x / kDraws;
  }
  // Standard errors sqrt(1, 2, 15, 96 / n); four of them.
  EXPECT_NEAR(m1, 0, 4 * std::sqrt(1.0 / kDraws));
  EXPECT_NEAR(m2, 1, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(m3, 0, 4 * std::sqrt(15.0 / kDraws));
  EXPECT_NEAR(m4, 3, 4 * std::sqrt(96.0 / kDraws));
  Random same({4});
  Random scaled({4});
  for (int i = 0; i < 100; ++i) EXPECT_DOUBLE_EQ(scaled.normal(5, 2), 5 + 2 * same.normal());
}

TEST(Random, RangesKeepTheirBounds) {
  Random random({5});
  double log_sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double linear = random.between(-2, 3);
    EXPECT_TRUE(linear >= -2 && linear < 3);
    const double logarithmic = random.log_between(0.01, 100);
    EXPECT_TRUE(logarithmic >= 0.01 && logarithmic < 100 * (1 + 1e-12));
    log_sum += std::log10(logarithmic);
  }
  // Uniform in the logarithm over four decades: standard error 4 / sqrt(12 * 10^4) = .012.
  EXPECT_NEAR(log_sum / 10000, 0, 0.05);
  EXPECT_EQ(random.between(7, 7), 7);
  EXPECT_EQ(random.log_between(7, 7), 7);
}

TEST(Random, BelowReachesEveryNumberEvenly) {
  Random random({6});
  EXPECT_EQ(random.below(1), 0);
  std::array<int, 10> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const int number = random.below(10);
    ASSERT_TRUE(number >= 0 && number < 10);
    ++counts[static_cast<std::size_t>(number)];
  }
  EXPECT_LT(chi_square(counts, kDraws / 10.0), 34);  // 9 degrees of freedom, once in ten thousand
  for (int i = 0; i < 1000; ++i) {
    const int number = random.below(2147483647);
    ASSERT_TRUE(number >= 0 && number < 2147483647);
  }
}

TEST(Random, ChanceIsTheShareOfYes) {
  Random random({8});
  int yes = 0;
  for (int i = 0; i < kDraws; ++i) yes += random.chance(0.2) ? 1 : 0;
  EXPECT_NEAR(yes, 0.2 * kDraws, 4 * std::sqrt(0.16 * kDraws));
  EXPECT_FALSE(random.chance(0));
  EXPECT_TRUE(random.chance(1));
}

TEST(Random, DirectionsFillTheSphereEvenly) {
  Random random({9});
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d d = random.direction().cast<double>();
    ASSERT_NEAR(d.norm(), 1, 1e-6);
    mean += d / kDraws;
    second += d * d.transpose() / kDraws;
  }
  // Standard errors: 1 / sqrt(3 n) of a mean, at most .3 / sqrt(n) of a second moment.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4.5 / std::sqrt(3.0 * kDraws));
  EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 4.5 * 0.3 / std::sqrt(kDraws));
}

TEST(Random, KeysAreThePathNotItsSum) {
  const std::vector<Random> generators = {Random({}),     Random({0}),    Random({0, 0}), Random({1}),
                                          Random({1, 2}), Random({2, 1}), Random({3}),    Random({0, 1, 2})};
  std::set<std::uint32_t> firsts;
  for (Random random : generators) firsts.insert(random.bits());
  EXPECT_EQ(firsts.size(), generators.size());
}

// Seeds and sample numbers come in a row, so neighbours have to be as unrelated as any two.
TEST(Random, NeighbouringKeysAndSplitsAreUnrelated) {
  const auto correlation = [](Random a, Random b) {
    double sum = 0;
    for (int i = 0; i < 20000; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5) * 12;
    return sum / 20000;
  };
  const double bound = 4.5 / std::sqrt(20000.0);
  const Random root({10});
  for (std::uint64_t k = 0; k < 8; ++k) {
    EXPECT_LT(std::abs(correlation(Random({1, k}), Random({1, k + 1}))), bound) << k;
    EXPECT_LT(std::abs(correlation(Random({k, 1}), Random({k + 1, 1}))), bound) << k;
    EXPECT_LT(std::abs(correlation(root.split(k), root.split(k + 1))), bound) << k;
    EXPECT_LT(std::abs(correlation(root, root.split(k))), bound) << k;
  }
  // Across keys at one place of the sequence: first draws of 64,000 neighbours fall evenly.
  std::array<int, 64> counts{};
  for (std::uint64_t k = 0; k < 64000; ++k) ++counts[static_cast<std::size_t>(Random({1, k}).uniform() * 64)];
  EXPECT_LT(chi_square(counts, 1000), 112);  // as above
  std::array<int, 64> of_splits{};
  for (std::uint64_t k = 0; k < 64000; ++k) ++of_splits[static_cast<std::size_t>(root.split(k).uniform() * 64)];
  EXPECT_LT(chi_square(of_splits, 1000), 112);
}

TEST(Random, SplittingLeavesTheParentAloneAndDoesNotDependOnItsDraws) {
  Random parent({11});
  Random twin({11});
  Random early = parent.split(1);
  EXPECT_EQ(parent.bits(), twin.bits());
  Random late = parent.split(1);
  EXPECT_EQ(early.bits(), late.bits());
  Random inner = parent.split(1).split(2);
  Random other = parent.split(2).split(1);
  EXPECT_NE(inner.bits(), other.bits());
}

}  // namespace
}  // namespace faceprobe

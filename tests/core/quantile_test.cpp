#include "faceprobe/core/quantile.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace faceprobe {
namespace {

// 0 .. count - 1 in an order of no use; `count` must not be a multiple of 7.
std::vector<int> shuffled_ranks(int count) {
  std::vector<int> values;
  for (int i = 0; i < count; ++i) values.push_back(7 * i % count);
  return values;
}

TEST(Quantile, IsTheValueOfItsRank) {
  const std::vector<int> values = shuffled_ranks(65);
  for (int rank = 0; rank <= 64; ++rank) EXPECT_EQ(quantile_of(values, rank / 64.0), rank);  // exact in binary
}

TEST(Quantile, RoundsRanksDownAndInterpolatesNothing) {
  EXPECT_EQ(quantile_of(std::vector<double>{10.0, 0.0}, 0.99), 0.0);
  EXPECT_EQ(quantile_of(std::vector<double>{4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile_of(std::vector<double>{4.0, 1.0, 3.0, 2.0}, 0.7), 3.0);  // rank 2.1
}

TEST(Quantile, EndsAreTheSmallestAndTheLargest) {
  const std::vector<float> values = {2.5F, -3.0F, 7.0F, 0.0F};
  EXPECT_EQ(quantile_of(values, 0.0), -3.0F);
  EXPECT_EQ(quantile_of(values, 1.0), 7.0F);
}

TEST(Quantile, ReckonsInTheTypeOfTheShare) {
  EXPECT_EQ(quantile_of(shuffled_ranks(11), 0.9F), 9);
  EXPECT_EQ(quantile_of(shuffled_ranks(11), static_cast<double>(0.9F)), 8);
}

TEST(Quantile, LeavesTheListAsItWas) {
  const std::vector<int> values = shuffled_ranks(50);
  std::vector<int> given = values;
  (void)quantile_of(given, 0.3);
  (void)upper_median_of(given);
  EXPECT_EQ(given, values);
}

TEST(Quantile, MoreValuesThanAFloatCounts) {
  std::vector<std::int8_t> values((1U << 24U) + 4, 0);  // the last rank is 2^24 + 3, which a float rounds up to 2^24 + 4
  values.front() = 1;
  EXPECT_EQ(quantile_of(std::move(values), 1.0F), 1);
}

TEST(Quantile, UpperMedianIsTheLargerOfTheMiddleTwo) {
  EXPECT_EQ(upper_median_of(shuffled_ranks(9)), 4);
  EXPECT_EQ(upper_median_of(shuffled_ranks(10)), 5);
  EXPECT_EQ(upper_median_of(std::vector<double>{4.0, 1.0}), 4.0);
}

TEST(Quantile, OneValueIsItsOwnQuantile) {
  EXPECT_EQ(quantile_of(std::vector<float>{3.0F}, 0.2), 3.0F);
  EXPECT_EQ(upper_median_of(std::vector<float>{3.0F}), 3.0F);
}

TEST(Quantile, NothingIsZero) {
  EXPECT_EQ(quantile_of(std::vector<float>{}, 0.5), 0.0F);
  EXPECT_EQ(upper_median_of(std::vector<double>{}), 0.0);
}

TEST(Quantile, EqualValuesAreAllTheSame) {
  const std::vector<float> values(100, 0.25F);
  EXPECT_EQ(quantile_of(values, 0.98), 0.25F);
  EXPECT_EQ(upper_median_of(values), 0.25F);
}

}  // namespace
}  // namespace faceprobe

#include "train/descent.h"

#include "faceprobe/core/error.h"
#include "support/expect_error.h"
#include "train/table.h"

#include <gtest/gtest.h>
#include <array>
#include <limits>
#include <vector>

namespace faceprobe::train {
namespace {

using faceprobe::testing::expect_error;

torch::nn::Linear one_weight(float value) {
  torch::nn::Linear linear(torch::nn::LinearOptions(1, 1).bias(false));
  const torch::NoGradGuard no_grad;
  linear->weight.fill_(value);
  return linear;
}

TEST(Schedule, RisesInALineAndFallsAlongAHalfCosine) {
  const Schedule schedule{.peak = 2, .steps = 110, .warm_up = 10, .final_share = 0.1};
  EXPECT_DOUBLE_EQ(learning_rate_at(schedule, 0), 0.2);
  EXPECT_DOUBLE_EQ(learning_rate_at(schedule, 9), 2);
  EXPECT_DOUBLE_EQ(learning_rate_at(schedule, 10), 2);
  EXPECT_NEAR(learning_rate_at(schedule, 60), 2 * 0.55, 1e-12);  // half way, half way between 1 and a tenth
  EXPECT_NEAR(learning_rate_at(schedule, 110), 0.2, 1e-12);
  EXPECT_NEAR(learning_rate_at(schedule, 500), 0.2, 1e-12);
  const Schedule without{.peak = 3, .steps = 10};
  EXPECT_DOUBLE_EQ(learning_rate_at(without, 0), 3);
}

// Adam's first step is the learning rate against the gradient's sign, whatever its size; the mean then takes nine tenths of the way.
TEST(Descent, AStepAndItsMeanAreThoseOfTheBook) {
  torch::nn::Linear linear = one_weight(1);
  Descent descent(linear.ptr(), {.schedule = {.peak = 0.01, .steps = 100}, .average_decay = 0.99});
  descent.begin(0);
  const torch::Tensor loss = 0.5 * linear->weight.square().sum();
  loss.backward();
  descent.end(0, loss.item<double>());
  EXPECT_NEAR(linear->weight.item<double>(), 0.99, 1e-6);
  {
    const AveragedWeights averaged(descent.average(), *linear);
    EXPECT_NEAR(linear->weight.item<double>(), 0.991, 1e-6);
  }
  EXPECT_NEAR(linear->weight.item<double>(), 0.99, 1e-6);
}

TEST(Descent, WithoutAMeanTheWeightsAreKeptAsTheyAre) {
  torch::nn::Linear linear = one_weight(1);
  Descent descent(linear.ptr(), {.schedule = {.peak = 0.03, .steps = 100}, .average_decay = 0});
  for (std::int64_t step = 0; step < 3; ++step) {
    descent.begin(step);
    linear->weight.square().sum().backward();
    descent.end(step, 0);
  }
  EXPECT_EQ(descent.average().values().front().item<float>(), linear->weight.item<float>());
}

TEST(Descent, WhatIsNoNumberIsRefusedBeforeItGetsIntoTheWeights) {
  torch::nn::Linear linear = one_weight(2);
  Descent descent(linear.ptr(), {.schedule = {.peak = 0.01, .steps = 100}});
  descent.begin(7);
  linear->weight.square().sum().backward();
  expect_error(ExitCode::kUnexpected, {"no number", "step 7", "learning rate"},
               [&] { descent.end(7, std::numeric_limits<double>::quiet_NaN()); });
  descent.begin(7);
  (linear->weight * std::numeric_limits<float>::infinity()).sum().backward();
  expect_error(ExitCode::kUnexpected, {"no number"}, [&] { descent.end(7, 1); });
  EXPECT_EQ(linear->weight.item<float>(), 2);
}

TEST(Table, GivesBackItsRows) {
  const std::vector<std::array<double, 2>> rows = {{1, 1.0 / 3}, {-2, 1e300}};
  EXPECT_EQ(rows_of<2>(table_of(rows)), rows);
  EXPECT_TRUE(rows_of<2>(table_of(std::vector<std::array<double, 2>>())).empty());
}

}  // namespace
}  // namespace faceprobe::train

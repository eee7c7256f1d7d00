#include "train/face_loss.h"

#include "faceprobe/core/region.h"
#include "net/face_outputs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

// One picture of 4 x 4 cheeks, and an estimate of it that is right.
struct Known {
  SurfaceBatch truth;
  net::FaceSurface found;

  Known() {
    torch::manual_seed(5);
    truth.normal = torch::randn({1, 3, 4, 4});
    truth.depth_m = torch::rand({1, 1, 4, 4});
    truth.weight = torch::ones({1, 1, 4, 4});
    truth.region = torch::full({1, 1, 4, 4}, static_cast<float>(Region::kCheeks));
    truth.shading = torch::rand({1, 3, 4, 4}) + 0.5;
    truth.lit = torch::ones({1, 1, 4, 4});
    truth.open = torch::rand({1, 3, 4, 4}) + 0.5;
    found.normal = truth.normal / truth.normal.square().sum(1, true).sqrt();
    found.spread = torch::full({1, 1, 4, 4}, 0.1);
    found.depth = truth.depth_m / net::FaceOutputs::kDepthUnit;
    found.log_level = truth.shading.mean(1, true).log();
    found.colour = truth.shading / truth.shading.mean(1, true);
    found.open_log_level = truth.open.mean(1, true).log();
    found.open_colour = truth.open / truth.open.mean(1, true);
    found.region = torch::zeros({1, kRegionCount, 4, 4});
    found.region.select(1, static_cast<int>(Region::kCheeks)).fill_(50);
  }
  double loss(const LossConfig& config) const { return surface_loss(found, truth, config).item<double>(); }
};

// Nothing but the one weight.
LossConfig only(double LossConfig::*weight) {
  LossConfig config;
  config.normal = config.spread = config.depth = config.region = config.shading = config.colour = config.open = 0;
  config.*weight = 1;
  return config;
}

TEST(FaceLoss, WhatIsRightCostsNothing) {
  const Known known;
  for (const auto weight : {&LossConfig::normal, &LossConfig::depth, &LossConfig::region, &LossConfig::shading,
                            &LossConfig::colour, &LossConfig::open})
    EXPECT_NEAR(known.loss(only(weight)), 0, 1e-4);
}

TEST(FaceLoss, TheChordIsTwiceTheSineOfHalfTheAngle) {
  for (const double angle : {0.01, 0.5, 1.5, 3.0}) {
    const torch::Tensor a = torch::tensor({0.0, 0.0, 7.0}).view({1, 3, 1, 1});
    const torch::Tensor b = torch::tensor({std::sin(angle), 0.0, std::cos(angle)}).view({1, 3, 1, 1});
    // The corner at zero takes up to its size off.
    EXPECT_NEAR(chord(a, b).item<double>(), 2 * std::sin(angle / 2), 1.1e-3);
  }
}

TEST(FaceLoss, AnOriginOfTheDepthDoesNotMatter) {
  Known known;
  known.found.depth = known.found.depth + 3;
  EXPECT_NEAR(known.loss(only(&LossConfig::depth)), 0, 1e-3);
}

TEST(FaceLoss, AWrongExposureCostsLessThanAWrongCourse) {
  Known level, course;
  level.found.log_level = level.found.log_level + 0.3;
  course.found.log_level = course.found.log_level + 0.3 * torch::tensor({1.0, -1.0}).repeat({8}).view({1, 1, 4, 4});
  EXPECT_NEAR(level.loss(only(&LossConfig::shading)), 0.3 * 0.3, 0.01);
  EXPECT_NEAR(course.loss(only(&LossConfig::shading)), 0.3, 0.01);
}

TEST(FaceLoss, OfTheOpenShadingCountsWhereItIsKnown) {
  Known known;
  const torch::Tensor lean = 0.3 * torch::tensor({1.0, -1.0}).repeat({8}).view({1, 1, 4, 4});
  known.found.open_log_level = known.found.open_log_level + lean;
  EXPECT_NEAR(known.loss(only(&LossConfig::open)), 0.3, 0.01);
  // Off the face it is 0, and a network of before has none.
  known.truth.open.zero_();
  EXPECT_NEAR(known.loss(only(&LossConfig::open)), 0, 1e-4);
  known.found.open_log_level = known.found.open_colour = torch::Tensor();
  EXPECT_EQ(known.loss(only(&LossConfig::open)), 0);
}

// Where 2 b is the error that is made.
TEST(FaceLoss, StatingTheErrorThatIsMadeCostsLeast) {
  Known known;
  known.found.normal = -known.found.normal.flip({1});
  const double made = chord(known.found.normal, known.truth.normal).mean().item<double>();
  const auto cost = [&](double stated) {
    known.found.spread = torch::full({1, 1, 4, 4}, stated);
    return known.loss(only(&LossConfig::spread));
  };
  EXPECT_LT(cost(made), cost(1.2 * made));
  EXPECT_LT(cost(made), cost(made / 1.2));
}

TEST(FaceLoss, TheStatedErrorDoesNotPullAtTheNormals) {
  Known known;
  known.found.normal = torch::randn({1, 3, 4, 4}).requires_grad_();
  known.found.spread = torch::full({1, 1, 4, 4}, 0.1).requires_grad_();
  surface_loss(known.found, known.truth, only(&LossConfig::spread)).backward();
  EXPECT_FALSE(known.found.normal.grad().defined() && known.found.normal.grad().abs().max().item<double>() > 0);
  EXPECT_GT(known.found.spread.grad().abs().max().item<double>(), 0);
}

TEST(FaceLoss, WhereNothingIsKnownNothingCounts) {
  Known known;
  known.truth.weight.zero_();
  known.truth.lit.zero_();
  known.found.normal = -known.found.normal;
  known.found.log_level = known.found.log_level + 5;
  for (const auto weight : {&LossConfig::normal, &LossConfig::shading, &LossConfig::colour})
    EXPECT_NEAR(known.loss(only(weight)), 0, 1e-4);
}

}  // namespace
}  // namespace faceprobe::train

#include "faceprobe/synth/procedural_head.h"
#include "small_head.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::synth {
namespace {

HeadModel named_model(std::vector<std::string> names) {
  HeadModel model = small_head();
  model.expression.assign(names.size(), Eigen::MatrixX3f::Zero(1, 3));
  model.expression_names = std::move(names);
  return model;
}

const std::vector<std::string> kIctNames = {
    "browDown_L",  "browDown_R",  "browInnerUp_L", "browInnerUp_R", "eyeBlink_L",    "eyeBlink_R",
    "eyeLookIn_L", "eyeLookIn_R", "eyeLookOut_L",  "eyeLookOut_R",  "eyeLookDown_L", "eyeLookDown_R",
    "eyeLookUp_L", "eyeLookUp_R", "jawOpen",       "mouthPucker",   "mouthSmile_L",  "mouthSmile_R",
    "eyeSquint_L", "eyeSquint_R", "mouthPress_L",  "mouthPress_R",  "mouthFunnel"};

float weight(const HeadModel& model, const Eigen::VectorXf& weights, const std::string& name) {
  const auto at = std::ranges::find(model.expression_names, name);
  return weights(at - model.expression_names.begin());
}

TEST(DrawIdentity, IsNormalWithTheDeviationAsked) {
  HeadModel model = small_head();
  model.identity.assign(4, Eigen::MatrixX3f::Zero(1, 3));
  Random random({1});
  constexpr int kHeads = 4000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kHeads; ++i) {
    const HeadParameters parameters = draw_identity(model, {.identity_deviation = 0.5F}, random);
    ASSERT_EQ(parameters.identity.size(), 4);
    sum += static_cast<double>(parameters.identity.sum());
    squares += static_cast<double>(parameters.identity.squaredNorm());
  }
  // 16,000 numbers: standard errors .5 / sqrt(16000) = .004 and .25 sqrt(2 / 16000) = .0028; five of each.
  EXPECT_NEAR(sum / (4 * kHeads), 0, 0.020);
  EXPECT_NEAR(squares / (4 * kHeads), 0.25, 0.014);
}

TEST(DrawIdentity, IsTheSameForTheSameKey) {
  const HeadModel model = procedural_head();
  Random one({3, 4});
  Random two({3, 4});
  Random other({3, 5});
  const Eigen::VectorXf identity = draw_identity(model, {}, one).identity;
  EXPECT_EQ(identity, draw_identity(model, {}, two).identity);
  EXPECT_NE(identity, draw_identity(model, {}, other).identity);
}

TEST(DrawExpression, WeightsStayBetweenZeroAndOne) {
  const HeadModel model = named_model(kIctNames);
  Random random({2});
  for (int i = 0; i < 2000; ++i) {
    const Eigen::VectorXf weights = draw_expression(model, {.neutral_share = 0}, random);
    ASSERT_EQ(weights.size(), static_cast<Eigen::Index>(kIctNames.size()));
    ASSERT_GE(weights.minCoeff(), 0);
    ASSERT_LE(weights.maxCoeff(), 1);
    ASSERT_GT(weights.maxCoeff(), 0);  // somebody who is not neutral does something
  }
}

TEST(DrawExpression, NeutralShareIsKept) {
  const HeadModel model = named_model(kIctNames);
  Random random({9});
  int neutral = 0;
  constexpr int kHeads = 4000;
  for (int i = 0; i < kHeads; ++i) neutral += draw_expression(model, {.neutral_share = 0.4F}, random).isZero() ? 1 : 0;
  EXPECT_NEAR(neutral / static_cast<double>(kHeads), 0.4, 0.04);  // standard error sqrt(.24 / 4000) = .008; five of them
}

TEST(DrawExpression, FacesDoWhatFacesDo) {
  const HeadModel model = named_model(kIctNames);
  Random random({4});
  int smiles = 0;
  int blinks = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::VectorXf weights = draw_expression(model, {.neutral_share = 0}, random);
    const float left = weight(model, weights, "mouthSmile_L");
    const float right = weight(model, weights, "mouthSmile_R");
    // Both corners move together: uneven by a normal of 8 %, five of them on either side.
    ASSERT_LE(std::abs(left - right), 0.8F * std::max(left, right) + 1e-6F);
    smiles += left > 0.2F ? 1 : 0;
    const float blink = weight(model, weights, "eyeBlink_L");
    ASSERT_TRUE(blink == 0 || blink >= 0.9F);  // open or closed; half-closed lids are the squint's
    blinks += blink > 0 ? 1 : 0;
    // Both eyes look the same way.
    ASSERT_EQ(weight(model, weights, "eyeLookOut_L"), weight(model, weights, "eyeLookIn_R"));
    ASSERT_EQ(weight(model, weights, "eyeLookOut_R"), weight(model, weights, "eyeLookIn_L"));
    ASSERT_TRUE(weight(model, weights, "eyeLookOut_L") == 0 || weight(model, weights, "eyeLookOut_R") == 0);
    // Nobody puckers the lips of a smile.
    ASSERT_TRUE(left == 0 || weight(model, weights, "mouthPucker") == 0);
  }
  EXPECT_GT(smiles, 600);  // shares .28 and .08 of 3000, far more than five standard errors away
  EXPECT_GT(blinks, 140);
}

TEST(DrawExpression, ArkitsNamesMeanTheSame) {
  std::vector<std::string> arkit;
  for (std::string name : kIctNames) {
    if (name.ends_with("_L")) name.replace(name.size() - 2, 2, "Left");
    if (name.ends_with("_R")) name.replace(name.size() - 2, 2, "Right");
    arkit.push_back(name);
  }
  const HeadModel ict = named_model(kIctNames);
  const HeadModel other = named_model(arkit);
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random one({6, i});
    Random two({6, i});
    EXPECT_EQ(draw_expression(ict, {}, one), draw_expression(other, {}, two));
  }
}

TEST(DrawExpression, StrangeNamesGiveOneExpressionAndNoNamesStatistics) {
  Random random({8});
  const HeadModel strange = named_model({"grumpy", "sleepy"});
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXf weights = draw_expression(strange, {.neutral_share = 0}, random);
    EXPECT_EQ((weights.array() > 0).count(), 1);
  }
  HeadModel unnamed = strange;
  unnamed.expression_names.clear();
  bool negative = false;
  for (int i = 0; i < 20; ++i)
    negative = negative || draw_expression(unnamed, {.neutral_share = 0}, random).minCoeff() < 0;
  EXPECT_TRUE(negative);
  HeadModel none = small_head();
  none.expression.clear();
  none.expression_names.clear();
  EXPECT_EQ(draw_expression(none, {.neutral_share = 0}, random).size(), 0);
}

}  // namespace
}  // namespace faceprobe::synth

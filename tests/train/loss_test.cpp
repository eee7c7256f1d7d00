#include "train/loss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

// Layers of even noise in double, so that differences show the slope.
Batch noise(std::int64_t size) {
  torch::manual_seed(3);
  const auto options = torch::kDouble;
  Batch batch;
  batch.linear = 0.5 + 0.5 * torch::rand({2, 3, size, size}, options);
  batch.highlight = 0.5 * torch::rand({2, 3, size, size}, options);
  batch.skin = torch::ones({2, 1, size, size}, options);
  return batch;
}

LossConfig everything() {
  LossConfig config;
  config.rms = 1;
  config.similarity = 1;
  return config;
}

TEST(HighlightLoss, OfTheTruthIsNothing) {
  const Batch batch = noise(16);
  // The corner of the smoothed root, 1e-3: a mean square of zero counts as its own size. Means divide by a millionth of a pixel more than
  // the 512 that there are.
  EXPECT_NEAR(highlight_loss(batch.highlight, batch, everything()).item<double>(), 1e-3, 1e-8);
}

TEST(HighlightLoss, ItsRootMeanSquareIsTheErrorOfALayerThatIsOffByTheSame) {
  const Batch batch = noise(16);
  LossConfig with;
  with.rms = 1;
  const torch::Tensor off = batch.highlight + 0.1;
  const double share = highlight_loss(off, batch, with).item<double>() - highlight_loss(off, batch, {}).item<double>();
  EXPECT_NEAR(share, std::sqrt(0.01 + 1e-6), 1e-9);
}

TEST(HighlightLoss, SimilarityFallsWithTheError) {
  const Batch batch = noise(16);
  LossConfig with;
  with.similarity = 1;
  const auto dissimilarity = [&](double share) {
    const torch::Tensor layer = (1 - share) * batch.highlight + share * (0.5 - batch.highlight);
    return highlight_loss(layer, batch, with).item<double>() - highlight_loss(layer, batch, {}).item<double>();
  };
  EXPECT_LT(dissimilarity(0.1), dissimilarity(0.3));
  EXPECT_LT(dissimilarity(0.3), dissimilarity(0.6));
  EXPECT_GT(dissimilarity(1), 1);  // the noise turned over: less alike than two that have nothing in common
}

TEST(HighlightLoss, GradientIsThatOfDifferences) {
  const Batch batch = noise(8);
  torch::Tensor layer = (0.5 * torch::rand_like(batch.highlight)).requires_grad_(true);
  highlight_loss(layer, batch, everything()).backward();
  const torch::NoGradGuard no_grad;
  constexpr double kStep = 1e-6;
  for (const std::int64_t place : {0, 40, 77, 191, 300, 383}) {
    const auto at = [&](double step) {
      torch::Tensor moved = layer.clone();
      moved.view(-1)[place] += step;
      return highlight_loss(moved, batch, everything()).item<double>();
    };
    const double difference = (at(kStep) - at(-kStep)) / (2 * kStep);
    // The smoothed absolute value bends on a scale of 1e-3, so the third derivative times the step squared is below 1e-6.
    EXPECT_NEAR(layer.grad().view(-1)[place].item<double>(), difference, 1e-6) << place;
  }
}

}  // namespace
}  // namespace faceprobe::train

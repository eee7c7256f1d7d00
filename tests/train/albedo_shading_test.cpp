#include "train/albedo_shading_loss.h"

#include "faceprobe/net/torch_shading_net.h"
#include "faceprobe/train/train.h"
#include "train/layer_truth.h"
#include "train/model.h"
#include "train/small_data.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

constexpr auto kDouble = torch::kDouble;  // so that differences show the slope

TEST(ScaleInvariantLoss, IsMeanSquareLessLambdaOfTheSquaredMean) {
  // Differences 1, 2, 3 in the channels of one pixel; another pixel of which nothing is known.
  const torch::Tensor truth = torch::zeros({1, 3, 1, 2}, kDouble);
  torch::Tensor found = torch::full({1, 3, 1, 2}, 9.0, kDouble);
  for (int c = 0; c < 3; ++c) found[0][c][0][0] = c + 1.0;
  const torch::Tensor known = torch::tensor({1.0, 0.0}, kDouble).view({1, 1, 1, 2});
  const auto loss = [&](double lambda) { return scale_invariant_loss(found, truth, known, lambda).item<double>(); };
  EXPECT_NEAR(loss(0), 14.0 / 3, 1e-12);
  EXPECT_NEAR(loss(0.5), 14.0 / 3 - 0.5 * 4, 1e-12);
  EXPECT_NEAR(loss(1), 2.0 / 3, 1e-12);
}

TEST(ScaleInvariantLoss, ALevelCostsNothingAtLambdaOneHalfAtAHalfAndIsEachPicturesOwn) {
  torch::manual_seed(3);
  const torch::Tensor truth = torch::rand({2, 3, 4, 4}, kDouble);
  const torch::Tensor known = torch::ones({2, 1, 4, 4}, kDouble);
  const torch::Tensor found = truth + torch::rand({2, 3, 4, 4}, kDouble);
  const torch::Tensor levels = torch::tensor({0.7, -2.0}, kDouble).view({2, 1, 1, 1});
  const auto loss = [&](const torch::Tensor& of, double lambda) {
    return scale_invariant_loss(of, truth, known, lambda).item<double>();
  };
  EXPECT_NEAR(loss(found + levels, 1), loss(found, 1), 1e-12);
  const double whole = (0.7 * 0.7 + 2.0 * 2.0) / 2;
  EXPECT_NEAR(loss(truth + levels, 0), whole, 1e-12);
  EXPECT_NEAR(loss(truth + levels, 0.5), whole / 2, 1e-12);
  EXPECT_NEAR(loss(truth + levels, 1), 0, 1e-12);
  // Of one channel alone it is a colour, and that costs: 0.3 in a third of the values.
  const torch::Tensor red = torch::tensor({0.3, 0.0, 0.0}, kDouble).view({1, 3, 1, 1});
  EXPECT_NEAR(loss(truth + red, 1), 0.09 / 3 - 0.01, 1e-12);
}

TEST(ScaleInvariantLoss, GradientIsThatOfDifferencesAndZeroWhereNothingIsKnown) {
  torch::manual_seed(3);
  const torch::Tensor truth = torch::rand({2, 3, 4, 4}, kDouble);
  torch::Tensor known = (torch::rand({2, 1, 4, 4}, kDouble) > 0.3).to(kDouble);
  known.select(0, 1).select(1, 0).zero_();
  for (const double lambda : {1.0, 0.5}) {
    torch::Tensor found = torch::rand({2, 3, 4, 4}, kDouble).requires_grad_(true);
    scale_invariant_loss(found, truth, known, lambda).backward();
    EXPECT_EQ((found.grad() * (1 - known)).abs().max().item<double>(), 0);
    constexpr double kStep = 1e-6;
    for (const std::int64_t place : {0, 5, 17, 40, 60, 95}) {
      const torch::NoGradGuard no_grad;
      const auto at = [&](double step) {
        torch::Tensor moved = found.clone();
        moved.view(-1)[place] += step;
        return scale_invariant_loss(moved, truth, known, lambda).item<double>();
      };
      // A square: rounding alone, 1e-16 over the step.
      EXPECT_NEAR(found.grad().view(-1)[place].item<double>(), (at(kStep) - at(-kStep)) / (2 * kStep), 1e-8)
          << place << " at " << lambda;
    }
  }
}

TEST(ScaleInvariantLoss, APictureOfWhichNothingIsKnownIsFinite) {
  torch::Tensor found = torch::rand({1, 3, 4, 4}).requires_grad_(true);
  const torch::Tensor loss = scale_invariant_loss(found, torch::rand({1, 3, 4, 4}), torch::zeros({1, 1, 4, 4}), 1);
  EXPECT_EQ(loss.item<float>(), 0);
  loss.backward();
  EXPECT_EQ(found.grad().abs().max().item<float>(), 0);
}

// Pictures whose layers are known.
Batch known_layers() {
  torch::manual_seed(3);
  const auto noise = [](std::int64_t channels) { return torch::rand({2, channels, 8, 8}, kDouble); };
  Batch batch;
  batch.surface.shading = 0.2 + noise(3);
  batch.highlight = 0.2 * noise(3);
  batch.linear = (0.1 + 0.5 * noise(3)) * batch.surface.shading + batch.highlight;
  batch.clip = torch::zeros_like(batch.linear);
  return batch;
}

TEST(AlbedoShadingLoss, OneLayerCostsAsMuchAsTheOtherAndTheTruthNothing) {
  const Batch batch = known_layers();
  const LayerTruth truth = layer_truth(batch);
  const torch::Tensor error = torch::rand({2, 3, 8, 8}, kDouble);
  for (const float offset : {0.5F, 0.02F}) {
    const net::AlbedoShadingOptions options{.offset = offset};
    const net::LogLayers right{net::log_of_light(truth.albedo, options), net::log_of_light(truth.shading, options)};
    EXPECT_NEAR(albedo_shading_loss(right, batch, options).item<double>(), 0, 1e-12);
    const net::LogLayers brighter{right.albedo - 1, right.shading + 2};
    EXPECT_NEAR(albedo_shading_loss(brighter, batch, options).item<double>(), 0, 1e-12);
    const double one = albedo_shading_loss({right.albedo + error, right.shading}, batch, options).item<double>();
    const double other = albedo_shading_loss({right.albedo, right.shading + error}, batch, options).item<double>();
    EXPECT_NEAR(one, other, 1e-12);
    EXPECT_GT(one, 0.01);
    EXPECT_NEAR(albedo_shading_loss({right.albedo + error, right.shading + error}, batch, options).item<double>(),
                one + other, 1e-12);
  }
}

// What is said of light at another level than its own holds of its colour too, as far as the offset is small.
TEST(AlbedoShadingLoss, ASmallOffsetKeepsTheColourAtAnyLevel) {
  const torch::Tensor light = torch::tensor({0.6, 0.5, 0.4}, kDouble);
  const auto red_over_blue = [&](float offset) {
    const net::AlbedoShadingOptions options{.offset = offset};
    const torch::Tensor back = net::light_of_log(net::log_of_light(light, options) + 0.5, options);
    return (back[0] / back[2]).item<double>();
  };
  // (k (x + e) - e) over the same of blue, k = exp(0.5) = 1.6487.
  EXPECT_NEAR(red_over_blue(0.5F), 1.3136 / 0.9838, 1e-3);
  EXPECT_NEAR(red_over_blue(0.02F), 1.5, 0.015);
}

TrainConfig tiny() {
  TrainConfig config;
  config.architecture = "albedo_shading";
  config.network = R"({"divisor":16,"offset":0.02})";
  config.batch = 4;
  config.steps = 200;
  config.learning_rate = 2e-3;
  config.warm_up = 10;
  config.average_decay = 0.9;
  config.validate_every = 100;
  config.validation_samples = 8;
  config.augment.occluder_share = 0;
  return config;
}

TEST(AlbedoShading, IsGivenTheDiffuseLayerAtItsOwnExposure) {
  const DataFolder folder("albedo_shading_given", 32, 4);
  const synth::ShardReader reader(folder.data());
  torch::manual_seed(1);
  const Model model = make_model(tiny());
  model.module->eval();
  const torch::NoGradGuard no_grad;
  Batch batch = plain_batch(reader, {0, 1}, tiny());
  ASSERT_TRUE(batch.surface.there());
  const torch::Tensor logs = model.forward(batch);
  EXPECT_EQ(logs.sizes(), (std::vector<std::int64_t>{2, 6, 32, 32}));
  // Another highlight on the same skin is not seen.
  batch.linear = batch.linear + 0.125;
  batch.highlight = batch.highlight + 0.125;
  EXPECT_LT((model.forward(batch) - logs).abs().max().item<float>(), 1e-6F);
  const FoundLayers found = model.layers(batch);
  EXPECT_GE(found.albedo.min().item<float>(), 0);
  EXPECT_GE(found.shading.min().item<float>(), 0);
  EXPECT_FALSE(model.highlight);
}

TEST(AlbedoShading, TwoHundredStepsLowerTheLossAndTheWeightsAreReadBack) {
  const DataFolder folder("albedo_shading", 32, 16);
  TrainRun run;
  run.config = tiny();
  run.data = run.validation_data = folder.data();
  run.folder = folder.run("run");
  run.threads = 1;
  int pictures = 0;
  TrainHooks hooks;
  hooks.write_picture = [&](const std::filesystem::path&, const ByteImage& picture) {
    ++pictures;
    EXPECT_FALSE(picture.empty());
  };
  const TrainReport report = train_highlight(run, hooks);
  ASSERT_TRUE(report.finished);
  ASSERT_EQ(report.rows.size(), 4U);
  EXPECT_GT(pictures, 0);
  // The discs' skin is reddish: an albedo that is grey everywhere is what a network that learnt nothing has.
  EXPECT_LT(report.rows.back().loss, 0.7 * report.rows.front().loss);
  const Validation& last = report.rows.back().validation;
  EXPECT_EQ(last.black_whole, 0) << "there are no highlights to measure";
  EXPECT_LT(last.colour_deg, 10);  // of white light; the skin's own colour would be off by 14

  const net::TorchShadingNet network(report.weights, {.threads = 1});
  EXPECT_TRUE(network.takes_diffuse());
  Image disc(32, 32, 3, 0.15F);
  for (std::size_t i = 0; i < disc.values().size(); i += 3) disc.data()[i] = 0.25F;
  const net::ShadingLayers layers = network.layers(disc);
  double red = 0;
  double green = 0;
  for (std::size_t i = 0; i < layers.albedo.values().size(); i += 3) {
    red += layers.albedo.data()[i];
    green += layers.albedo.data()[i + 1];
  }
  EXPECT_GT(red, 1.1 * green) << "1 to 0.6 in all it has seen";
}

}  // namespace
}  // namespace faceprobe::train

#include "train/shi_loss.h"

#include "faceprobe/core/error.h"
#include "faceprobe/train/train.h"
#include "train/layer_truth.h"
#include "train/model.h"
#include "train/small_data.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace faceprobe::train {
namespace {

// Pictures whose layers are known, in double, so that differences show the slope.
Batch known_layers(std::int64_t count, std::int64_t size) {
  torch::manual_seed(3);
  const auto options = torch::kDouble;
  const auto noise = [&](std::int64_t channels) { return torch::rand({count, channels, size, size}, options); };
  Batch batch;
  batch.surface.shading = 0.2 + noise(3);
  batch.highlight = 0.2 * noise(3);
  batch.linear = (0.1 + 0.5 * noise(3)) * batch.surface.shading + batch.highlight;
  batch.clip = torch::zeros_like(batch.linear);
  batch.skin = torch::ones({count, 1, size, size}, options);
  return batch;
}

net::ShiLayers right(const Batch& batch) {
  const LayerTruth truth = layer_truth(batch);
  return {truth.albedo, truth.shading, batch.highlight};
}

TEST(ShiLoss, TruthIsWhatTheLayersMakeThePictureOf) {
  const Batch batch = known_layers(2, 8);
  const LayerTruth truth = layer_truth(batch);
  EXPECT_TRUE(torch::allclose(truth.albedo * truth.shading + batch.highlight, batch.linear));
  EXPECT_EQ(truth.known.sum().item<double>(), 2 * 8 * 8);
}

TEST(ShiLoss, NothingIsKnownInTheDarkNorOfWhatIsClipped) {
  Batch batch = known_layers(1, 8);
  batch.surface.shading.narrow(3, 0, 2).select(1, 1).zero_();
  batch.clip.narrow(3, 7, 1).select(1, 2).fill_(1);
  const LayerTruth truth = layer_truth(batch);
  EXPECT_EQ(truth.known.sum().item<double>(), 8 * 5);
  EXPECT_EQ(truth.known.narrow(3, 2, 5).min().item<double>(), 1);
  EXPECT_LE(truth.albedo.max().item<double>(), 1);
  // What is said there costs nothing.
  net::ShiLayers found = right(batch);
  found.albedo = found.albedo + 7 * (1 - truth.known);
  found.shading = found.shading + 7 * (1 - truth.known);
  EXPECT_NEAR(shi_loss(found, batch).item<double>(), 0, 1e-12);
}

TEST(ShiLoss, TheTruthCostsNothingAndAnOffHighlightItsSquare) {
  const Batch batch = known_layers(2, 8);
  net::ShiLayers found = right(batch);
  EXPECT_NEAR(shi_loss(found, batch).item<double>(), 0, 1e-12);
  found.highlight = found.highlight + 0.1;
  EXPECT_NEAR(shi_loss(found, batch).item<double>(), 0.01, 1e-12);
}

TEST(ShiLoss, AScaledTruthCostsNothingWithinTheLimits) {
  const Batch batch = known_layers(2, 8);
  const LayerTruth truth = layer_truth(batch);
  for (const double scale : {0.11, 0.5, 1.0, 9.9})
    EXPECT_NEAR(scale_invariant_error(scale * truth.albedo, truth.albedo, truth.known).item<double>(), 0, 1e-12)
        << scale;
  // Of each channel and picture by itself.
  const torch::Tensor scales = torch::tensor({0.2, 1.0, 3.0, 7.0, 0.5, 2.0}, torch::kDouble).view({2, 3, 1, 1});
  EXPECT_NEAR(scale_invariant_error(scales * truth.albedo, truth.albedo, truth.known).item<double>(), 0, 1e-12);
  // Beyond them what is left over: 10 x 0.05 is half the truth, 0.1 x 20 twice as much.
  const double square = truth.albedo.square().mean().item<double>();
  const auto cost = [&](double scale) {
    return scale_invariant_error(scale * truth.albedo, truth.albedo, truth.known).item<double>();
  };
  EXPECT_NEAR(cost(0.05), 0.25 * square, 1e-12);
  EXPECT_NEAR(cost(20), square, 1e-12);
}

TEST(ShiLoss, AScaleIsATwentiethOfWhatItWouldCost) {
  const Batch batch = known_layers(2, 8);
  net::ShiLayers found = right(batch);
  found.shading = 1.5 * found.shading;
  const double whole = (0.5 * batch.surface.shading).square().mean().item<double>();
  EXPECT_NEAR(shi_loss(found, batch).item<double>(), 0.05 * whole, 1e-12);
}

TEST(ShiLoss, GradientIsThatOfDifferencesAndFiniteForEmptyLayers) {
  const Batch batch = known_layers(2, 4);
  torch::Tensor layers = torch::rand({2, 9, 4, 4}, torch::kDouble).requires_grad_(true);
  // One channel that is as good as nothing meets the limit of its scale.
  {
    const torch::NoGradGuard no_grad;
    layers.select(1, 4).mul_(1e-3);
  }
  const auto loss = [&](const torch::Tensor& all) {
    return shi_loss({all.narrow(1, 0, 3), all.narrow(1, 3, 3), all.narrow(1, 6, 3)}, batch);
  };
  loss(layers).backward();
  constexpr double kStep = 1e-6;
  for (const std::int64_t place : {0, 17, 70, 130, 150, 280}) {
    const torch::NoGradGuard no_grad;
    const auto at = [&](double step) {
      torch::Tensor moved = layers.clone();
      moved.view(-1)[place] += step;
      return loss(moved).item<double>();
    };
    // The loss is a square but for the scales; rounding is 1e-16 of it over the step.
    EXPECT_NEAR(layers.grad().view(-1)[place].item<double>(), (at(kStep) - at(-kStep)) / (2 * kStep), 1e-8) << place;
  }
  torch::Tensor nothing = torch::zeros({2, 9, 4, 4}, torch::kFloat).requires_grad_(true);
  loss(nothing).backward();
  EXPECT_TRUE(torch::isfinite(nothing.grad()).all().item<bool>());
  EXPECT_GT(nothing.grad().abs().max().item<double>(), 0);
}

TEST(ShiLoss, APictureWithoutShadingStillTellsOfItsHighlight) {
  Batch batch = known_layers(1, 4);
  batch.surface.shading.zero_();
  torch::Tensor layers = torch::rand({1, 9, 4, 4}, torch::kDouble).requires_grad_(true);
  const net::ShiLayers found{layers.narrow(1, 0, 3), layers.narrow(1, 3, 3), layers.narrow(1, 6, 3)};
  const torch::Tensor loss = shi_loss(found, batch);
  EXPECT_NEAR(loss.item<double>(), (found.highlight - batch.highlight).square().mean().item<double>(), 1e-12);
  loss.backward();
  EXPECT_TRUE(torch::isfinite(layers.grad()).all().item<bool>());
}

TrainConfig small_shi() {
  TrainConfig config;
  config.architecture = "shi";
  config.network = R"({"widths":[8,8,8,8,8,8]})";
  config.batch = 4;
  config.learning_rate = 5e-3;
  config.warm_up = 1;
  config.average_decay = 0.9;
  return config;
}

TEST(Shi, LearnsAFewPicturesAndTheirThreeLayers) {
  const DataFolder folder("shi_toy", 64, 4);
  const synth::ShardReader reader(folder.data());
  torch::manual_seed(1);
  const Model model = make_model(small_shi());
  const Batch batch = plain_batch(reader, {0, 1, 2, 3}, small_shi());
  ASSERT_TRUE(batch.surface.there());
  torch::optim::AdamW optimizer(model.module->parameters(), torch::optim::AdamWOptions(3e-3));
  double first = 0;
  double last = 0;
  for (int step = 0; step < 120; ++step) {
    optimizer.zero_grad();
    const torch::Tensor loss = model.loss(batch, {});
    loss.backward();
    torch::nn::utils::clip_grad_norm_(model.module->parameters(), 1);
    optimizer.step();
    last = loss.item<double>();
    if (step == 0) first = last;
  }
  EXPECT_LT(last, 0.5 * first);
  // Albedo and shading are most of the loss; of the highlight, more is found than the empty layer of a network that learnt nothing of it.
  const torch::NoGradGuard no_grad;
  model.module->eval();
  const torch::Tensor error = model.highlight(batch) - batch.highlight;
  EXPECT_LT(error.square().mean().item<double>(), batch.highlight.square().mean().item<double>());
}

TrainReport trained(const std::filesystem::path& data, const std::filesystem::path& folder) {
  TrainRun run;
  run.config = small_shi();
  run.config.steps = 2;
  run.data = run.validation_data = data;
  run.folder = folder;
  run.threads = 1;
  return train_highlight(run, {});
}

std::string refusal(const DataFolder& folder) {
  try {
    trained(folder.data(), folder.run("run"));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "accepted";
}

TEST(Shi, TrainsAsTheOthersDo) {
  const DataFolder folder("shi", 32, 8);
  const TrainReport report = trained(folder.data(), folder.run("run"));
  EXPECT_TRUE(report.finished);
  EXPECT_TRUE(std::isfinite(report.rows.back().loss));
  EXPECT_TRUE(report.rows.back().validated);
  EXPECT_TRUE(std::filesystem::exists(report.weights));
}

TEST(Shi, NeedsNoMeshes) {
  const DataFolder folder("shi_no_mesh", 32, 8);
  std::filesystem::remove(folder.data() / synth::mesh_name(0));
  EXPECT_TRUE(trained(folder.data(), folder.run("run")).finished);
}

TEST(Shi, DataWithoutShadingAreRefused) {
  const DataFolder folder("shi_no_shading", 32, 8);
  const std::filesystem::path shard = folder.data() / synth::shard_name(0);
  std::ifstream in(shard, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  in.close();
  const std::size_t at = bytes.find("sample.shading");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 14, "sample.nothing");
  std::ofstream(shard, std::ios::binary) << bytes;
  EXPECT_NE(refusal(folder).find("shading"), std::string::npos);
}

}  // namespace
}  // namespace faceprobe::train

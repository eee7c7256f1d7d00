#include "train/channels_last.h"

#include "train/model.h"

#include <gtest/gtest.h>

namespace faceprobe::train {
namespace {

// Noise of 32 px as batches have it: N x H x W x C in memory.
Batch noise_batch() {
  const auto pictures = [](int channels) { return torch::rand({2, 32, 32, channels}).permute({0, 3, 1, 2}); };
  Batch batch;
  batch.linear = pictures(3);
  batch.clip = torch::zeros({2, 32, 32, 3}).permute({0, 3, 1, 2});
  batch.mask = torch::ones({2, 32, 32, 1}).permute({0, 3, 1, 2});
  batch.highlight = 0.2 * batch.linear;
  batch.surface.mesh = pictures(3);
  return batch;
}

TEST(ChannelsLast, EveryConvolutionHasItAndTheAnswersAreTheSame) {
  for (const char* architecture : {"unet", "face", "mscr", "shi", "albedo_shading"}) {
    TrainConfig config;
    config.architecture = architecture;
    if (config.architecture == "unet" || config.architecture == "face") config.network = R"({"widths":[8,16]})";
    torch::manual_seed(5);
    const Model model = make_model(config);
    model.module->eval();
    int convolutions = 0;
    for (const auto& part : model.module->modules()) {
      const auto* conv = part->as<torch::nn::Conv2d>();
      if (conv == nullptr) continue;
      ++convolutions;
      EXPECT_TRUE(conv->weight.is_contiguous(torch::MemoryFormat::ChannelsLast)) << architecture;
    }
    EXPECT_GT(convolutions, 4) << architecture;
    const torch::NoGradGuard no_grad;
    const Batch batch = noise_batch();
    const torch::Tensor turned = model.forward(batch);
    for (torch::Tensor& parameter : model.module->parameters()) parameter.set_data(parameter.contiguous());
    const torch::Tensor plain = model.forward(batch);
    // Sums of up to some thousand floats in another order, over ten to twenty layers.
    EXPECT_LT((turned - plain).abs().max().item<double>(), 1e-4 * plain.abs().max().item<double>() + 1e-6)
        << architecture;
  }
}

TEST(ChannelsLast, TheOptimiserStillMovesTheWeights) {
  torch::manual_seed(5);
  TrainConfig config;
  config.network = R"({"widths":[8,16]})";
  const Model model = make_model(config);
  Batch batch = noise_batch();
  batch.highlight = 0.5 * batch.linear;
  batch.skin = torch::ones_like(batch.mask);
  torch::optim::AdamW optimizer(model.module->parameters(), torch::optim::AdamWOptions(1e-2));
  const double before = model.loss(batch, config.loss).item<double>();
  for (int step = 0; step < 20; ++step) {
    optimizer.zero_grad();
    model.loss(batch, config.loss).backward();
    optimizer.step();
  }
  EXPECT_LT(model.loss(batch, config.loss).item<double>(), 0.9 * before);
}

}  // namespace
}  // namespace faceprobe::train

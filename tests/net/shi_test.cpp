#include "net/torch/shi.h"

#include "faceprobe/net/torch_highlight_net.h"
#include "net/fixtures.h"
#include "net/torch/weights.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;

ShiOptions small_shi() { return {.widths = {4, 4, 8, 8, 8, 8}}; }

// Seen some pictures, so that its running means and variances are no longer those it was made with.
Shi used_shi(std::uint64_t seed, const ShiOptions& options) {
  torch::manual_seed(seed);
  Shi net(options);
  const torch::NoGradGuard no_grad;
  for (int i = 0; i < 5; ++i) net(torch::rand({2, 3, 64, 64}));
  net->eval();
  return net;
}

float apart(const ShiLayers& a, const ShiLayers& b) {
  const torch::Tensor off = torch::cat({a.albedo - b.albedo, a.shading - b.shading, a.highlight - b.highlight}, 1);
  return off.abs().max().item<float>();
}

TEST(Shi, LayersHaveTheSizeOfTheInputAndAreNotNegative) {
  const torch::InferenceMode inference;
  for (const int stride : {1, 2}) {
    Shi net(ShiOptions{.first_stride = stride});
    net->eval();
    for (const auto& [height, width] : {std::pair{64, 64}, {128, 128}, {192, 192}, {64, 192}}) {
      const ShiLayers out = net(torch::rand({1, 3, height, width}));
      for (const torch::Tensor& layer : {out.albedo, out.shading, out.highlight}) {
        EXPECT_EQ(layer.sizes(), (std::vector<std::int64_t>{1, 3, height, width}));
        EXPECT_GE(layer.min().item<float>(), 0);
      }
    }
  }
}

TEST(Shi, HasTheParametersOfThePaper) {
  Shi net(ShiOptions{});
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : net->parameters()) count += parameter.numel();
  // A convolution of `in` to `out` channels, with scale and shift behind it.
  const auto unit = [](std::int64_t in, std::int64_t out) { return 9 * in * out + 2 * out; };
  const std::int64_t encoder =
      unit(3, 16) + unit(16, 32) + unit(32, 64) + unit(64, 128) + unit(128, 256) + unit(256, 256);
  const std::int64_t decoder = 4 * unit(256, 256) + unit(1024, 256) + unit(1024, 128) + unit(512, 64) + unit(256, 32) +
                               unit(128, 16) + unit(64, 16) + unit(16, 3);
  EXPECT_EQ(count, encoder + 3 * decoder);
}

TEST(Shi, DecodersAreLinkedBeforeTheirLastTwoConvolutions) {
  torch::manual_seed(5);
  Shi net(small_shi());
  net(torch::rand({2, 3, 64, 64})).highlight.sum().backward();
  const auto slope = [&](const std::string& name, std::int64_t of, std::int64_t parts) {
    const torch::Tensor gradient = net->named_parameters()[name].grad();
    return gradient.chunk(parts, 0)[static_cast<std::size_t>(of)].abs().max().item<float>();
  };
  for (const std::int64_t decoder : {0, 1, 2}) {
    EXPECT_GT(slope("middle.3.conv.weight", decoder, 3), 0) << decoder;
    EXPECT_GT(slope("decoder.4.conv.weight", decoder, 3), 0) << decoder;
    EXPECT_EQ(slope("layers.conv.weight", decoder, 3) > 0, decoder == 2) << decoder;
    EXPECT_EQ(slope("last.conv.weight", decoder, 3) > 0, decoder == 2) << decoder;
  }
}

TEST(Shi, AUnitNormalisesByTheBatchInTrainingAndByWhatItSawAfterwards) {
  torch::manual_seed(5);
  const torch::NoGradGuard no_grad;
  ShiUnit unit(3, 4, 1, 1);
  const torch::Tensor x = torch::rand({4, 3, 16, 16});
  const torch::Tensor beside_others = unit(torch::cat({x.narrow(0, 0, 2), 0.1 * x.narrow(0, 2, 2)}));
  // Half of it, that below the mean, is cut off.
  const torch::Tensor trained = unit(x);
  EXPECT_NEAR((trained > 0).to(torch::kFloat).mean().item<float>(), 0.5F, 0.1F);
  EXPECT_GT((trained - beside_others).narrow(0, 0, 2).abs().max().item<float>(), 0.1F);
  // A tenth of what is missing each time: 0.9 to the 200th is below 1e-9.
  for (int i = 0; i < 200; ++i) unit(x);
  unit->eval();
  const torch::Tensor used = unit(x);
  // What is left is the running variance's N / (N - 1) with N = 1024: half a thousandth on values up to five deviations.
  EXPECT_LT((trained - used).abs().max().item<float>(), 3e-3F);
  EXPECT_LT((unit(x.narrow(0, 1, 1)) - used.narrow(0, 1, 1)).abs().max().item<float>(), 1e-5F);
}

TEST(Shi, WeightsComeBackFromTheFileWithTheRunningMeans) {
  const testing::TempFolder folder;
  Shi saved = used_shi(1, small_shi()), loaded = used_shi(2, small_shi());
  const torch::NoGradGuard no_grad;
  const torch::Tensor x = torch::rand({1, 3, 64, 64});
  ASSERT_GT(apart(saved(x), loaded(x)), 0.01F);
  save_weights(*saved, folder / "w", {}, false);
  load_weights(*loaded, folder / "w");
  EXPECT_EQ(apart(saved(x), loaded(x)), 0);
}

TEST(Shi, ItsFileTakesAnySizeAndStaysWithinThePicture) {
  const testing::TempFolder folder;
  for (const int stride : {1, 2}) {
    ShiOptions options = small_shi();
    options.first_stride = stride;
    const Shi net = used_shi(1, options);
    save_weights(*net, folder / "w", {{kArchitectureKey, kShiArchitecture}, {kOptionsKey, options_json(options)}}, true);
    const TorchHighlightNet used(folder / "w", {.threads = 1});
    EXPECT_EQ(used.info().architecture, "shi");
    const Image picture = testing::random_picture(45, 70, 0, 1);
    const Image highlight = used.highlight(picture, {}, {});
    ASSERT_TRUE(highlight.same_size(picture));
    double sum = 0;
    for (std::size_t i = 0; i < highlight.values().size(); ++i) {
      ASSERT_GE(highlight.values()[i], 0);
      ASSERT_LE(highlight.values()[i], picture.values()[i]);
      sum += highlight.values()[i];
    }
    EXPECT_GT(sum, 0);
  }
}

TEST(Shi, InputIsLightWithinThePicture) {
  const torch::Tensor light = torch::tensor({-1.0F, 0.5F, 2.0F}).view({1, 3, 1, 1});
  EXPECT_TRUE(torch::equal(shi_input(light), torch::tensor({0.0F, 0.5F, 1.0F}).view({1, 3, 1, 1})));
}

TEST(Shi, OptionsSurviveTheFileAndAreChecked) {
  const ShiOptions options{.widths = {1, 2, 3, 4, 5, 512}, .first_stride = 2};
  EXPECT_EQ(shi_options_from_json(options_json(options)), options);
  for (const auto& [text, part] : {std::pair{R"({"widths":[8,8],"first_stride":1})", "2 numbers"},
                                   {R"({"widths":[8,8,8,8,8,0],"first_stride":1})", "1 to 512"},
                                   {R"({"widths":[8,8,8,8,8,513],"first_stride":1})", "1 to 512"},
                                   {R"({"widths":[8,8,8,8,8,8],"first_stride":3})", "1 or 2"},
                                   {R"({"widths":[8,8,8,8,8,8]})", "first_stride"},
                                   {R"({"widths":[8,8,8,8,8,8],"first_stride":1,"mean":[0,0,0]})", "mean"},
                                   {"{}", "missing"}}) {
    expect_error(ExitCode::kModel, {part}, [&, &text = text] { shi_options_from_json(text); });
  }
  EXPECT_THROW(Shi(ShiOptions{.widths = {0, 8, 8, 8, 8, 8}}), std::invalid_argument);
}

TEST(Shi, WrongInputsAreRefused) {
  Shi net(small_shi());
  EXPECT_THROW(net(torch::rand({1, 3, 64, 48})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 1, 64, 64})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 3, 32, 32})), std::invalid_argument);  // to train on; one pixel is left of it
  net->eval();
  EXPECT_NO_THROW(net(torch::rand({1, 3, 32, 32})));
  Shi halved(ShiOptions{.widths = small_shi().widths, .first_stride = 2});
  EXPECT_THROW(halved(torch::rand({2, 3, 96, 96})), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::net

#include "net/torch/albedo_shading.h"

#include "faceprobe/core/mirror.h"
#include "faceprobe/net/torch_shading_net.h"
#include "net/fixtures.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/shi.h"
#include "net/torch/weights.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

const AlbedoShadingOptions kSmall{.offset = 0.02F, .divisor = 16};

// As filled its answers are next to nothing; these weights keep the spread of what goes in.
AlbedoShading speaking(const AlbedoShadingOptions& options) {
  torch::manual_seed(1);
  AlbedoShading net(options);
  const torch::NoGradGuard no_grad;
  for (torch::Tensor& parameter : net->parameters()) {
    if (parameter.dim() == 4)
      parameter.normal_(0, 1 / std::sqrt(static_cast<double>(parameter.numel() / parameter.size(0))));
  }
  net->eval();
  return net;
}

void write(const AlbedoShading& net, const std::filesystem::path& path) {
  save_weights(*net, path,
               {{kArchitectureKey, kAlbedoShadingArchitecture}, {kOptionsKey, options_json(net->options())}}, false);
}

TEST(AlbedoShading, BothLayersHaveTheSizeOfTheInput) {
  const torch::InferenceMode inference;
  AlbedoShading net(AlbedoShadingOptions{});
  net->eval();
  for (const int size : {128, 256, 416}) {
    const LogLayers out = net(torch::rand({1, 3, size, size}));
    EXPECT_EQ(out.albedo.sizes(), (std::vector<std::int64_t>{1, 3, size, size}));
    EXPECT_EQ(out.shading.sizes(), out.albedo.sizes());
  }
  EXPECT_EQ(AlbedoShading(kSmall)(torch::rand({2, 3, 32, 96})).shading.sizes(),
            (std::vector<std::int64_t>{2, 3, 32, 96}));
}

// MSCR's figures (mscr_test.cpp), with the last convolution and the way up twice.
TEST(AlbedoShading, HasTheParametersOfThePrototxt) {
  AlbedoShading net(AlbedoShadingOptions{});
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : net->parameters()) count += parameter.numel();
  const std::int64_t scale_1 = 34'944 + 307'456 + 885'120 + 663'936 + 442'624 + (16'448 + 64);
  const std::int64_t scale_2 = (23'424 + 96) + (256'064 + 64) + 2 * (102'464 + 64);
  const std::int64_t branch = (102'464 + 64) + 12'291;
  EXPECT_EQ(count, scale_1 + scale_2 + 2 * branch);
}

TEST(AlbedoShading, ABranchLearnsFromItsOwnLayerAndTheTrunkFromBoth) {
  for (const bool of_albedo : {true, false}) {
    const AlbedoShading net = speaking(kSmall);
    const LogLayers out = AlbedoShading(net)(torch::rand({1, 3, 64, 64}));
    (of_albedo ? out.albedo : out.shading).square().sum().backward();
    const auto slope = [&](const char* name) {
      const torch::Tensor gradient = net->named_parameters()[name].grad();
      return gradient.defined() ? gradient.abs().max().item<float>() : 0.0F;
    };
    for (const char* name : {"albedo.weight", "albedo_up.weight"}) EXPECT_EQ(slope(name) > 0, of_albedo) << name;
    for (const char* name : {"shading.weight", "shading_up.weight"}) EXPECT_EQ(slope(name) > 0, !of_albedo) << name;
    EXPECT_GT(slope("s2_4.weight"), 0);
  }
}

TEST(AlbedoShading, LightComesBackFromItsLogarithm) {
  const torch::Tensor light = torch::tensor({0.0F, 0.01F, 0.5F, 3.0F});
  for (const float offset : {0.5F, 0.02F}) {
    const AlbedoShadingOptions options{.offset = offset};
    EXPECT_TRUE(torch::allclose(light_of_log(log_of_light(light, options), options), light, 1e-5, 1e-6));
    EXPECT_NEAR(log_of_light(light, options)[0].item<float>(), std::log(offset), 1e-6);
    EXPECT_EQ(light_of_log(torch::tensor({-50.0F}), options).item<float>(), 0);
    EXPECT_TRUE(std::isfinite(light_of_log(torch::tensor({1e6F}), options).item<float>()));
  }
}

TEST(AlbedoShading, OptionsSurviveTheFileAndAreChecked) {
  const AlbedoShadingOptions options{{0.1F, 0.2F, 0.3F}, 0.02F, 4};
  EXPECT_EQ(albedo_shading_options_from_json(options_json(options)), options);
  for (const auto& [text, part] : {std::pair{R"({"mean":[0,0],"offset":0.5,"divisor":1})", "2 numbers"},
                                   {R"({"mean":[0,0,7],"offset":0.5,"divisor":1})", "-1 to 1"},
                                   {R"({"mean":[0,0,0],"offset":0,"divisor":1})", "0.001 to 1"},
                                   {R"({"mean":[0,0,0],"offset":"much","divisor":1})", "no number"},
                                   {R"({"mean":[0,0,0],"offset":0.5,"divisor":3})", "1, 2, 4, 8 or 16"},
                                   {R"({"mean":[0,0,0],"offset":0.5,"divisor":32})", "1, 2, 4, 8 or 16"},
                                   {R"({"mean":[0,0,0],"offset":0.5})", "missing"},
                                   {"{}", "missing"}}) {
    expect_error(ExitCode::kModel, {part}, [&, &text = text] { albedo_shading_options_from_json(text); });
  }
  EXPECT_THROW(AlbedoShading(AlbedoShadingOptions{.divisor = 3}), std::invalid_argument);
}

TEST(AlbedoShading, WrongInputsAreRefused) {
  AlbedoShading net(kSmall);
  EXPECT_THROW(net(torch::rand({1, 3, 64, 48})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 1, 64, 64})), std::invalid_argument);
}

TEST(TorchShadingNet, ReadsItsWeightsBackAndAnswersTheMeanOfBothWays) {
  const testing::TempFolder folder;
  AlbedoShading net = speaking(kSmall);
  write(net, folder / "w");
  const TorchShadingNet used(folder / "w", {.threads = 1});
  EXPECT_EQ(used.info().architecture, "albedo_shading");
  EXPECT_TRUE(used.takes_diffuse());
  Image picture = random_picture(64, 32, 0, 1);
  const ShadingLayers found = used.layers(picture);
  const torch::NoGradGuard no_grad;
  const torch::Tensor x = albedo_shading_input(tensor_view(picture), kSmall);
  const torch::Tensor back = net(x.flip(3)).shading.flip(3);
  const Image expected = crop_to_picture(light_of_log(0.5 * (net(x).shading + back), kSmall), 64, 32);
  ASSERT_TRUE(found.shading.same_size(expected));
  float least = 1e9F;
  float most = 0;
  for (std::size_t i = 0; i < expected.values().size(); ++i) {
    // Floats summed in another order over ten layers.
    ASSERT_NEAR(found.shading.data()[i], expected.data()[i], 1e-3F * (1 + expected.data()[i]));
    least = std::min(least, expected.data()[i]);
    most = std::max(most, expected.data()[i]);
  }
  EXPECT_GT(most, 1.01F * least) << "a network that says nothing proves nothing";
}

TEST(TorchShadingNet, TakesAnySizeAndMirrorsWithThePicture) {
  const testing::TempFolder folder;
  write(speaking(kSmall), folder / "w");
  const TorchShadingNet used(folder / "w", {.threads = 1});
  const Image picture = random_picture(45, 70, 0, 1);
  const ShadingLayers found = used.layers(picture);
  const ShadingLayers other = used.layers(mirrored(picture));
  for (const auto& [a, b] : {std::pair{&found.albedo, &other.albedo}, {&found.shading, &other.shading}}) {
    ASSERT_TRUE(a->same_size(picture));
    const Image turned = mirrored(*b);
    for (std::size_t i = 0; i < a->values().size(); ++i) {
      ASSERT_GE(a->data()[i], 0);
      ASSERT_NEAR(a->data()[i], turned.data()[i], 1e-5F * (1 + a->data()[i]));  // the same two, added in the other order
    }
  }
  EXPECT_TRUE(used.layers(Image(0, 0, 3)).shading.empty());
  EXPECT_THROW(used.layers(Image(8, 8, 1)), std::invalid_argument);
}

TEST(TorchShadingNet, ShisNetworkIsGivenThePhoto) {
  const testing::TempFolder folder;
  torch::manual_seed(1);
  const ShiOptions options{.widths = {4, 4, 8, 8, 8, 8}};
  save_weights(*Shi(options), folder / "w",
               {{kArchitectureKey, kShiArchitecture}, {kOptionsKey, options_json(options)}}, false);
  const TorchShadingNet used(folder / "w", {.threads = 1});
  EXPECT_FALSE(used.takes_diffuse());
  const ShadingLayers found = used.layers(random_picture(45, 70, 0, 1));
  for (const Image* layer : {&found.albedo, &found.shading}) {
    EXPECT_EQ(layer->width(), 45);
    EXPECT_EQ(layer->height(), 70);
    for (const float value : layer->values()) ASSERT_GE(value, 0);
  }
}

TEST(TorchShadingNet, WhatDoesNotFitIsRefused) {
  const testing::TempFolder folder;
  testing::write_mscr(folder / "w");
  expect_error(ExitCode::kModel, {"'mscr'", "albedo_shading and shi"}, [&] { TorchShadingNet net(folder / "w"); });
  expect_error(ExitCode::kUsage, {"threads"}, [&] { TorchShadingNet(folder / "w", {.threads = -1}); });
  // The U-Net's tensors under this network's name.
  save_weights(*UNet(testing::small_options()), folder / "w",
               {{kArchitectureKey, kAlbedoShadingArchitecture}, {kOptionsKey, options_json(kSmall)}}, true);
  expect_error(ExitCode::kModel, {"conv1.weight"}, [&] { TorchShadingNet net(folder / "w"); });
}

}  // namespace
}  // namespace faceprobe::net

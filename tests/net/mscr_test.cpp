#include "net/torch/mscr.h"

#include "net/fixtures.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;

TEST(Mscr, OutputHasTheSizeOfTheInput) {
  const torch::InferenceMode inference;
  Mscr net(MscrOptions{});
  net->eval();
  for (const auto& [height, width] : {std::pair{128, 128}, {256, 256}, {416, 416}, {32, 96}}) {
    const torch::Tensor out = net(torch::rand({1, 3, height, width}));
    EXPECT_EQ(out.sizes(), (std::vector<std::int64_t>{1, 3, height, width}));
  }
}

TEST(Mscr, HasTheParametersOfThePrototxt) {
  Mscr net(MscrOptions{});
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : net->parameters()) count += parameter.numel();
  const std::int64_t scale_1 = 34'944 + 307'456 + 885'120 + 663'936 + 442'624 + (16'448 + 64);
  const std::int64_t scale_2 = (23'424 + 96) + (256'064 + 64) + 3 * (102'464 + 64) + 12'291;
  EXPECT_EQ(count, scale_1 + scale_2);
  ASSERT_EQ(net->buffers().size(), 1U);
  EXPECT_FALSE(net->buffers()[0].requires_grad());
}

TEST(Mscr, IsFilledAsThePrototxtSays) {
  torch::manual_seed(5);
  Mscr net(MscrOptions{});
  const auto parameters = net->named_parameters();
  for (const auto& item : parameters) {
    const std::string& name = item.key();
    const torch::Tensor& value = item.value();
    if (name.ends_with("prelu.weight")) {
      EXPECT_TRUE((value == 0.25).all().item<bool>()) << name;
    } else if (name.ends_with("bias")) {
      const bool one = name == "conv2.bias" || name == "conv5.bias";
      EXPECT_TRUE((value == (one ? 1 : 0)).all().item<bool>()) << name;
    } else {
      const double deviation = name == "s2_1.weight" || name == "up.weight" ? 0.001 : 0.01;
      EXPECT_NEAR(value.std().item<double>(), deviation, 0.05 * deviation) << name;
      EXPECT_NEAR(value.mean().item<double>(), 0, 0.05 * deviation) << name;
    }
  }
}

TEST(Mscr, GrowsAConstantToAConstant) {
  const torch::Tensor grown = grow_8_times(torch::full({1, 3, 5, 6}, 0.75F), bilinear_filter());
  ASSERT_EQ(grown.sizes(), (std::vector<std::int64_t>{1, 3, 40, 48}));
  const torch::Tensor interior = grown.narrow(2, 4, 32).narrow(3, 4, 40);
  EXPECT_LT((interior - 0.75F).abs().max().item<float>(), 1e-6F);
  EXPECT_LT(grown[0][0][0][0].item<float>(), 0.4F);  // and only there: beyond the edge it is 0
}

TEST(Mscr, GrowsARampToARampInItsOwnChannel) {
  torch::Tensor x = torch::zeros({1, 2, 3, 6});
  x[0][1] = torch::arange(6, torch::kFloat32).expand({3, 6});
  const torch::Tensor grown = grow_8_times(x, bilinear_filter());
  EXPECT_EQ(grown[0][0].abs().max().item<float>(), 0);
  for (int column = 4; column < 44; ++column) {
    EXPECT_NEAR(grown[0][1][12][column].item<float>(), (column + 0.5) / 8 - 0.5, 1e-5) << column;
  }
}

TEST(Mscr, GrowsAsCaffesTransposedConvolutionDoes) {
  torch::manual_seed(3);
  const torch::Tensor x = torch::randn({2, 3, 4, 5});
  const torch::Tensor filter = bilinear_filter();
  const torch::Tensor expected = torch::conv_transpose2d(x, filter.expand({3, 1, 16, 16}), {}, 8, 4, 0, 3);
  // Four products of single precision in another order.
  EXPECT_LT((grow_8_times(x, filter) - expected).abs().max().item<float>(), 1e-5F);
}

TEST(Mscr, DropsOutInTrainingOnly) {
  torch::manual_seed(5);
  const torch::NoGradGuard no_grad;
  Mscr net(MscrOptions{});
  const torch::Tensor x = torch::rand({1, 3, 64, 64});
  EXPECT_FALSE(torch::equal(net(x), net(x)));
  net->eval();
  EXPECT_TRUE(torch::equal(net(x), net(x)));
}

TEST(Mscr, InputIsLightLessTheMean) {
  const MscrOptions options{{0.5F, 0.25F, 0}};
  const torch::Tensor light = torch::tensor({-1.0F, 0.5F, 2.0F}).view({1, 3, 1, 1});
  const torch::Tensor expected = torch::tensor({-0.5F, 0.25F, 1.0F}).view({1, 3, 1, 1});
  EXPECT_TRUE(torch::equal(mscr_input(light, options), expected));
}

TEST(Mscr, OptionsSurviveTheFileAndAreChecked) {
  const MscrOptions options{{0.1F, 0.2F, 0.3F}};
  EXPECT_EQ(mscr_options_from_json(options_json(options)), options);
  for (const auto& [text, part] : {std::pair{R"({"mean":[0,0]})", "2 numbers"},
                                   {R"({"mean":[0,0,7]})", "-1 to 1"},
                                   {R"({"mean":[0,0,1e999]})", "no JSON object"},
                                   {R"({"mean":["a",0,0]})", "no number"},
                                   {"{}", "missing"}}) {
    expect_error(ExitCode::kModel, {part}, [&, &text = text] { mscr_options_from_json(text); });
  }
}

TEST(Mscr, WrongInputsAreRefused) {
  Mscr net(MscrOptions{});
  EXPECT_THROW(net(torch::rand({1, 3, 64, 48})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 1, 64, 64})), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::net

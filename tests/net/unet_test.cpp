#include "net/torch/unet.h"

#include "net/fixtures.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;

std::int64_t parameter_count(const torch::nn::Module& module) {
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : module.parameters()) count += parameter.numel();
  return count;
}

TEST(UNet, OutputHasTheSizeOfTheInput) {
  const torch::NoGradGuard no_grad;
  UNet net(UNetOptions{});
  EXPECT_EQ(net->multiple(), 32);
  EXPECT_EQ(net(torch::rand({2, 7, 64, 96})).sizes(), (std::vector<std::int64_t>{2, 4, 64, 96}));
  EXPECT_EQ(net(torch::rand({1, 7, 32, 32})).sizes(), (std::vector<std::int64_t>{1, 4, 32, 32}));
}

TEST(UNet, IsAsSmallAsItSays) {
  const std::int64_t count = parameter_count(*UNet(UNetOptions{}));
  EXPECT_GT(count, 1'000'000);
  EXPECT_LT(count, 1'600'000);
}

TEST(UNet, TheFormatInMemoryDoesNotMatter) {
  const torch::NoGradGuard no_grad;
  torch::manual_seed(3);
  UNet net(testing::small_options());
  const torch::Tensor x = torch::rand({1, 7, 32, 40});
  const torch::Tensor interleaved = x.contiguous(torch::MemoryFormat::ChannelsLast);
  EXPECT_LT((net(x) - net(interleaved)).abs().max().item<float>(), 1e-5F);
}

// Every parameter is used, and the finest detail of every channel arrives at the output.
TEST(UNet, EverythingTakesPart) {
  torch::manual_seed(3);
  UNet net(testing::small_options());
  const torch::Tensor x = torch::rand({1, 7, 16, 16}).requires_grad_();
  (net(x) * torch::rand({1, 4, 16, 16})).sum().backward();
  for (const auto& item : net->named_parameters()) {
    EXPECT_GT(item.value().grad().abs().sum().item<float>(), 0) << item.key();
  }
  EXPECT_GT(x.grad().abs().min().item<float>(), 0);
}

TEST(UNet, WrongInputsAreRefused) {
  UNet net(testing::small_options());
  EXPECT_THROW(net(torch::rand({1, 7, 20, 16})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 7, 16, 12})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({1, 3, 16, 16})), std::invalid_argument);
  EXPECT_THROW(net(torch::rand({7, 16, 16})), std::invalid_argument);
}

TEST(UNet, OptionsSurviveTheFile) {
  const UNetOptions options{.in_channels = 3, .out_channels = 5, .widths = {16, 24}, .convs_per_level = 3};
  EXPECT_EQ(unet_options_from_json(options_json(options)), options);
}

TEST(UNet, OptionsAreChecked) {
  EXPECT_TRUE(UNetOptions{}.validate().empty());
  const std::vector<std::pair<UNetOptions, std::string>> bad = {{{.in_channels = 0}, "in_channels"},
                                                                {{.out_channels = 65}, "out_channels"},
                                                                {{.widths = {}}, "number of widths"},
                                                                {{.widths = {32, 60}}, "60"},
                                                                {{.widths = {0}}, "0"},
                                                                {{.widths = {1024}}, "1024"},
                                                                {{.widths = {8, 8, 8, 8, 8, 8, 8}}, "7"},
                                                                {{.convs_per_level = 0}, "convs_per_level"}};
  for (const auto& [options, part] : bad) {
    EXPECT_NE(options.validate().find(part), std::string::npos) << options.validate();
    EXPECT_THROW(UNet{options}, std::invalid_argument);
    expect_error(ExitCode::kModel, {part}, [&, &options = options] { unet_options_from_json(options_json(options)); });
  }
}

TEST(UNet, OptionsThatAreNotItsOwnAreRefused) {
  const std::string rest = R"("in_channels":7,"out_channels":4,"convs_per_level":2)";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "no JSON object"},
      {"[]", "no JSON object"},
      {"{" + rest + "}", "\"widths\" is missing"},
      {"{" + rest + R"(,"widths":8})", "no list"},
      {"{" + rest + R"(,"widths":[8.5]})", "no whole number"},
      {"{" + rest + R"(,"widths":[4294967304]})", "out of range"},
      {"{" + rest + R"(,"widths":[-4294967304]})", "out of range"},
      {"{" + rest + R"(,"widths":[8],"norm":"batch"})", "norm"}};
  for (const auto& [text, part] : bad) {
    expect_error(ExitCode::kModel, {part}, [&, &text = text] { unet_options_from_json(text); });
  }
}

}  // namespace
}  // namespace faceprobe::net

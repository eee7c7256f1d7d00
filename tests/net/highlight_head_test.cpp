#include "net/torch/highlight_head.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace faceprobe::net {
namespace {

TEST(HighlightHead, HighlightNeverExceedsThePicture) {
  torch::manual_seed(11);
  for (const float spread : {0.1F, 5.0F, 300.0F, 1e38F}) {
    const torch::Tensor raw = torch::randn({2, 4, 64, 64}) * spread;
    torch::Tensor light = torch::rand({2, 3, 64, 64}).pow(4) * 2;
    light[0].narrow(1, 0, 16).zero_();
    light[0][1].zero_();                     // a channel at zero beside two that are not
    light[1].narrow(1, 0, 16).fill_(1);      // clipped
    light[1].narrow(1, 16, 8).mul_(-1);      // below zero
    light[1].narrow(1, 24, 8).mul_(1e-38F);  // denormal
    light[1].narrow(1, 32, 8).mul_(1e38F);
    const torch::Tensor highlight = highlight_from_raw(raw, light);
    EXPECT_TRUE(torch::isfinite(highlight).all().item<bool>()) << spread;
    EXPECT_TRUE((highlight >= 0).all().item<bool>()) << spread;
    EXPECT_TRUE((highlight <= light.clamp_min(0)).all().item<bool>()) << spread;
  }
}

torch::Tensor head_of(std::vector<double> raw, std::vector<double> light) {
  return highlight_from_raw(torch::tensor(raw, torch::kFloat64).view({1, 4, 1, 1}),
                            torch::tensor(light, torch::kFloat64).view({1, 3, 1, 1}))
      .flatten();
}

TEST(HighlightHead, SmallAmountsHaveTheColourOfTheLight) {
  const double luminance = 0.2126 * 0.8 + 0.7152 * 0.5 + 0.0722 * 0.4;
  const torch::Tensor grey = head_of({0, 1, 1, 1}, {0.8, 0.5, 0.4});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey[c].item<double>(), 0.126928 * luminance, 2e-4) << c;
  const torch::Tensor red = head_of({0, 3, 0, 0}, {0.8, 0.5, 0.4});
  EXPECT_GT(red[0].item<double>(), 3 * red[1].item<double>());
  EXPECT_NEAR(red[1].item<double>(), red[2].item<double>(), 1e-5);  // the bend tells them apart a little
}

TEST(HighlightHead, LargeAmountsTakeThePictureWhole) {
  const torch::Tensor all = head_of({100, 0, 0, 0}, {0.8, 0.5, 0.4});
  EXPECT_NEAR(all[0].item<double>(), 0.8, 1e-6);  // single precision
  EXPECT_NEAR(all[2].item<double>(), 0.4, 1e-6);
}

TEST(HighlightHead, ExposureCancelsOut) {
  torch::manual_seed(12);
  const torch::Tensor raw = torch::randn({1, 4, 8, 8});
  const torch::Tensor light = torch::rand({1, 3, 8, 8});
  const torch::Tensor difference = highlight_from_raw(raw, light * 4) - 4 * highlight_from_raw(raw, light);
  EXPECT_LT(difference.abs().max().item<float>(), 1e-5F);  // rounding of sums of numbers up to 4
}

TEST(HighlightHead, GradientAgreesWithDifferences) {
  torch::manual_seed(13);
  torch::Tensor raw = torch::randn({1, 4, 3, 5}, torch::kFloat64) * 2;
  raw.narrow(1, 0, 1).add_(1.5);  // about half of the bends at work
  const torch::Tensor light = torch::rand({1, 3, 3, 5}, torch::kFloat64);
  const torch::Tensor weights = torch::rand({1, 3, 3, 5}, torch::kFloat64) + 0.5;
  const auto loss = [&](const torch::Tensor& at) { return (highlight_from_raw(at, light) * weights).sum(); };

  const torch::Tensor variable = raw.clone().requires_grad_();
  loss(variable).backward();
  const torch::Tensor analytic = variable.grad().flatten();
  constexpr double kStep = 1e-6;
  for (std::int64_t i = 0; i < raw.numel(); ++i) {
    torch::Tensor up = raw.clone(), down = raw.clone();
    up.view(-1)[i] += kStep;
    down.view(-1)[i] -= kStep;
    const double numeric = (loss(up) - loss(down)).item<double>() / (2 * kStep);
    EXPECT_NEAR(analytic[i].item<double>(), numeric, 1e-7)
        << i;  // rounding of the loss, some 1e-14, over the step, and curvature
  }
  EXPECT_GT(analytic.abs().max().item<double>(), 0.05);  // there is a slope to agree on
}

TEST(HighlightHead, GradientIsFiniteWhereThereIsNoLight) {
  const torch::Tensor raw = torch::zeros({1, 4, 1, 1}).requires_grad_();
  const torch::Tensor light = torch::zeros({1, 3, 1, 1}).requires_grad_();
  highlight_from_raw(raw, light).sum().backward();
  EXPECT_TRUE(torch::isfinite(raw.grad()).all().item<bool>());
  EXPECT_TRUE(torch::isfinite(light.grad()).all().item<bool>());
}

TEST(PrepareInput, ChannelsAreWhatTheyAreSaidToBe) {
  const torch::Tensor light = torch::tensor({-1.0F, 1.0F, 0.21763764F}).view({1, 3, 1, 1});
  const torch::Tensor clip = torch::tensor({0, 1, 0}).view({1, 3, 1, 1});
  const torch::Tensor mask = torch::ones({1, 1, 1, 1}, torch::kBool);
  const torch::Tensor input = prepare_input(light, clip, mask).flatten();
  ASSERT_EQ(input.numel(), kInputChannels);
  const std::array<float, 7> expected = {-0.5F, 0.5F, 0, -0.5F, 0.5F, -0.5F, 0.5F};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(input[i].item<float>(), expected[static_cast<std::size_t>(i)], 2e-3F) << i;
  }
}

TEST(PrepareInput, HugeLightStaysFinite) {
  const torch::Tensor light = torch::full({1, 3, 2, 2}, 3e38F);
  const torch::Tensor input = prepare_input(light, torch::ones({1, 3, 2, 2}), torch::ones({1, 1, 2, 2}));
  EXPECT_LT(input.max().item<float>(), 10);
}

TEST(HighlightHead, WrongChannelsAreRefused) {
  EXPECT_THROW(highlight_from_raw(torch::rand({1, 3, 4, 4}), torch::rand({1, 3, 4, 4})), std::invalid_argument);
  EXPECT_THROW(highlight_from_raw(torch::rand({1, 4, 4, 4}), torch::rand({1, 1, 4, 4})), std::invalid_argument);
  EXPECT_THROW(prepare_input(torch::rand({1, 3, 4, 4}), torch::rand({1, 1, 4, 4}), torch::rand({1, 1, 4, 4})),
               std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::net

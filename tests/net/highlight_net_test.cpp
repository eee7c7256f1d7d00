#include "faceprobe/net/highlight_net.h"

#include "faceprobe/net/both_ways.h"
#include "faceprobe/net/torch_highlight_net.h"
#include "net/fixtures.h"
#include "net/torch/weights.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

// What holds for the network without libtorch and with it.
template <class Net>
class HighlightNetTest : public ::testing::Test {
 protected:
  HighlightNetTest() { testing::write_unet(path(), testing::small_options()); }
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }
  Net unet() const { return Net(path(), {.threads = 1}); }
  testing::TempFolder folder_;
};
using Nets = ::testing::Types<HighlightNet, TorchHighlightNet>;
TYPED_TEST_SUITE(HighlightNetTest, Nets);

// The promise of the header, for any picture.
void expect_within_picture(const Image& highlight, const Image& picture) {
  ASSERT_TRUE(highlight.same_size(picture));
  ASSERT_EQ(highlight.channels(), 3);
  for (std::size_t i = 0; i < highlight.values().size(); ++i) {
    const float most = std::isfinite(picture.values()[i]) ? std::max(picture.values()[i], 0.0F) : 0.0F;
    ASSERT_GE(highlight.values()[i], 0) << i;
    ASSERT_LE(highlight.values()[i], most) << i;
  }
}

double sum(const Image& picture) {
  double total = 0;
  for (const float value : picture.values()) total += value;
  return total;
}

TYPED_TEST(HighlightNetTest, AnySizeIsTaken) {
  const TypeParam net = this->unet();
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 50}, {16, 16}, {33, 17}}) {
    const Image picture = random_picture(width, height, 0, 1);
    const Image highlight = net.highlight(picture, {}, {});
    expect_within_picture(highlight, picture);
    EXPECT_GT(sum(highlight), 0);
  }
  EXPECT_TRUE(net.highlight(Image(0, 5, 3), {}, {}).empty());
}

// What is beyond the edge is the edge repeated: cropping a padded picture is the same as giving it padded.
TYPED_TEST(HighlightNetTest, PadsByRepeatingTheEdge) {
  const TypeParam net = this->unet();
  const Image picture = random_picture(21, 18, 0, 1);
  Image padded(24, 24, 3);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      for (int c = 0; c < 3; ++c) padded(x, y, c) = picture(std::min(x, 20), std::min(y, 17), c);
    }
  }
  const Image highlight = net.highlight(picture, {}, {}), whole = net.highlight(padded, {}, {});
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 21; ++x) EXPECT_EQ(highlight(x, y, 1), whole(x, y, 1));
  }
}

TYPED_TEST(HighlightNetTest, AgreesWithTheNetworkItself) {
  torch::manual_seed(1);
  UNet net(testing::small_options());
  load_weights(*net, this->path());
  const Image picture = random_picture(16, 8, 0, 1);
  ByteImage clip(16, 8, 1), mask(16, 8, 1, 255);
  clip(5, 3) = 0b100;
  const torch::NoGradGuard no_grad;
  torch::Tensor light = torch::zeros({1, 3, 8, 16}), flags = torch::zeros({1, 3, 8, 16});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) light[0][c][y][x] = picture(x, y, c);
    }
  }
  flags[0][2][3][5] = 1;
  const torch::Tensor raw =
      net(torch::cat({light.clamp_min(1e-6).pow(1 / 2.2), flags, torch::ones({1, 1, 8, 16})}, 1) - 0.5);
  const torch::Tensor y = 0.2126 * light[0][0] + 0.7152 * light[0][1] + 0.0722 * light[0][2];
  const torch::Tensor colour = torch::softplus(raw[0].narrow(0, 1, 3)) + 1e-3;
  const torch::Tensor amount = y * torch::softplus(raw[0][0] - 2) * colour / colour.mean(0);
  const torch::Tensor expected = amount / (1 + (amount / light[0]).pow(4)).pow(0.25);
  const Image highlight = this->unet().highlight(picture, clip, mask);
  for (int row = 0; row < 8; ++row) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(highlight(x, row, c), expected[c][row][x].item<float>(), 1e-5F);
    }
  }
}

TYPED_TEST(HighlightNetTest, HostilePicturesStayWithinTheBound) {
  Image picture = random_picture(40, 24, -0.5F, 2);
  picture(3, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  picture(30, 20, 2) = std::numeric_limits<float>::infinity();
  picture(31, 20, 1) = -std::numeric_limits<float>::infinity();
  picture(8, 9, 1) = std::numeric_limits<float>::max();
  picture(9, 9, 1) = std::numeric_limits<float>::denorm_min();
  const ByteImage clip(40, 24, 1, 7);
  expect_within_picture(this->unet().highlight(picture, clip, {}), picture);
  const Image black(40, 24, 3);
  EXPECT_EQ(this->unet().highlight(black, {}, {}), black);
}

TYPED_TEST(HighlightNetTest, NaNCountsAsBlack) {
  Image picture = random_picture(16, 16, 0, 1), black = picture;
  picture(3, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  black(3, 4, 0) = 0;
  const TypeParam net = this->unet();
  EXPECT_EQ(net.highlight(picture, {}, {}), net.highlight(black, {}, {}));
}

TYPED_TEST(HighlightNetTest, OutsideTheMaskThereIsNothing) {
  const TypeParam net = this->unet();
  const Image picture = random_picture(16, 16, 0.1F, 1);
  ByteImage mask(16, 16, 1, 1);
  for (int x = 0; x < 16; ++x) mask(x, 5) = 0;
  const Image highlight = net.highlight(picture, {}, mask);
  for (int x = 0; x < 16; ++x) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(highlight(x, 5, c), 0);
      EXPECT_GT(highlight(x, 6, c), 0);
    }
  }
}

TYPED_TEST(HighlightNetTest, ClippingIsSeen) {
  const TypeParam net = this->unet();
  const Image picture = random_picture(16, 16, 0.1F, 1);
  EXPECT_NE(net.highlight(picture, ByteImage(16, 16, 1, 7), {}), net.highlight(picture, {}, {}));
  EXPECT_NE(net.highlight(picture, ByteImage(16, 16, 1, 1), {}), net.highlight(picture, ByteImage(16, 16, 1, 4), {}));
}

TYPED_TEST(HighlightNetTest, GreyGivesGrey) {
  Image grey = random_picture(20, 16, 0, 1);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 20; ++x) grey(x, y, 1) = grey(x, y, 2) = grey(x, y, 0);
  }
  Image nearly = grey;
  nearly(0, 0, 2) += 1e-6F;
  const TypeParam net = this->unet();
  {
    const Image highlight = net.highlight(grey, {}, {}), coloured = net.highlight(nearly, {}, {});
    expect_within_picture(highlight, grey);
    EXPECT_GT(sum(highlight), 0);
    bool any_colour = false;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 20; ++x) {
        const float* rgb = highlight.pixel(x, y);
        EXPECT_EQ(rgb[0], rgb[1]);
        EXPECT_EQ(rgb[1], rgb[2]);
        const float* other = coloured.pixel(x, y);
        EXPECT_NEAR(rgb[0], (other[0] + other[1] + other[2]) / 3, 1e-4F);
        any_colour |= other[0] != other[1];
      }
    }
    EXPECT_TRUE(any_colour);
  }
}

TYPED_TEST(HighlightNetTest, WrongCallsAreRefused) {
  const TypeParam net = this->unet();
  const Image picture(8, 8, 3);
  EXPECT_THROW(net.highlight(Image(8, 8, 1), {}, {}), std::invalid_argument);
  EXPECT_THROW(net.highlight(picture, ByteImage(8, 8, 3), {}), std::invalid_argument);
  EXPECT_THROW(net.highlight(picture, {}, ByteImage(8, 7, 1)), std::invalid_argument);
  expect_error(ExitCode::kUsage, {"threads", "-1"}, [&] { TypeParam(this->path(), {.threads = -1}); });
}

TYPED_TEST(HighlightNetTest, FilesThatDoNotFitAreRefused) {
  const auto expect_refused = [&](const std::string& architecture, const std::string& options, const std::string& part) {
    save_weights(*UNet(testing::small_options()), this->path(),
                 {{kArchitectureKey, architecture}, {kOptionsKey, options}}, true);
    expect_error(ExitCode::kModel, {part}, [&] { TypeParam net(this->path()); });
  };
  expect_refused("resnet", "{}", "'resnet'");
  expect_refused("unet", "{}", "missing");
  expect_refused("unet", options_json(UNetOptions{}), "encoder.0");
  expect_refused("unet", options_json(UNetOptions{.in_channels = 3}), "3 channels in");
  expect_error(ExitCode::kModel, {"absent"}, [&] { TypeParam(this->folder_ / "absent"); });
}

// The shipped size, a picture that is no multiple, all features on: what differs is the order of sums.
TEST(HighlightNets, AgreeWithAndWithoutLibtorch) {
  const testing::TempFolder folder;
  testing::write_unet(folder / "w", {.widths = {24, 48, 72, 112, 144}});
  const Image picture = random_picture(117, 126, 0, 1.2F);
  ByteImage clip(117, 126, 1), mask(117, 126, 1, 1);
  for (int x = 20; x < 60; ++x) clip(x, 40) = 5, mask(x, 80) = 0;
  const Image own = HighlightNet(folder / "w").highlight(picture, clip, mask);
  const Image torchs = TorchHighlightNet(folder / "w").highlight(picture, clip, mask);
  for (std::size_t i = 0; i < own.values().size(); ++i) ASSERT_NEAR(own.values()[i], torchs.values()[i], 2e-5F) << i;
  torch::set_num_threads(1);
}

TEST(HighlightNets, OneThreadIsAsGoodAsMany) {
  const testing::TempFolder folder;
  testing::write_unet(folder / "w", {.widths = {24, 48, 72, 112, 144}});
  const Image picture = random_picture(128, 112, 0, 1);
  const Image one = HighlightNet(folder / "w", {.threads = 1}).highlight(picture, {}, {});
  for (const int threads : {2, 3, 7})
    EXPECT_EQ(HighlightNet(folder / "w", {.threads = threads}).highlight(picture, {}, {}), one);
}

TEST(HighlightNets, BothWaysIsTheSameForTheMirrorImage) {
  const testing::TempFolder folder;
  testing::write_unet(folder / "w", testing::small_options());
  const HighlightNet net(folder / "w", {.threads = 1});
  const Image picture = random_picture(23, 18, 0, 1.2F);
  ByteImage clip(23, 18, 1), mask(23, 18, 1, 1);
  clip(4, 5) = 3, mask(20, 2) = 0;
  const Image highlight = highlight_both_ways(net, picture, clip, mask);
  EXPECT_EQ(highlight_both_ways(net, mirrored(picture), mirrored(clip), mirrored(mask)), mirrored(highlight));
  EXPECT_NE(highlight, net.highlight(picture, clip, mask));  // no network is symmetric by itself
  expect_within_picture(highlight, picture);
}

TEST(HighlightNets, TheQuickOneRunsNoMscr) {
  const testing::TempFolder folder;
  testing::write_mscr(folder / "w");
  expect_error(ExitCode::kModel, {"'mscr'", "unet"}, [&] { HighlightNet net(folder / "w"); });
}

}  // namespace
}  // namespace faceprobe::net

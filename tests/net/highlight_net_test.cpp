#include "faceprobe/net/highlight_net.h"

#include "faceprobe/core/parallel.h"
#include "net/fixtures.h"
#include "net/weights.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

class HighlightNetTest : public ::testing::Test {
 protected:
  HighlightNetTest() { testing::write_unet(path(), testing::small_options()); }
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }
  HighlightNet unet() const { return HighlightNet(path(), {.threads = 1}); }
  HighlightNet mscr() const {
    testing::write_mscr(path());
    return HighlightNet(path(), {.threads = 1});
  }
  testing::TempFolder folder_;
};

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

TEST_F(HighlightNetTest, AnySizeIsTaken) {
  const HighlightNet net = unet();
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 50}, {16, 16}, {33, 17}}) {
    const Image picture = random_picture(width, height, 0, 1);
    const Image highlight = net.highlight(picture, {}, {});
    expect_within_picture(highlight, picture);
    EXPECT_GT(sum(highlight), 0);
  }
  EXPECT_TRUE(net.highlight(Image(0, 5, 3), {}, {}).empty());
}

// What is beyond the edge is the edge repeated: cropping a padded picture is the same as giving it padded.
TEST_F(HighlightNetTest, PadsByRepeatingTheEdge) {
  const HighlightNet net = unet();
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

TEST_F(HighlightNetTest, AgreesWithTheNetworkItself) {
  torch::manual_seed(1);
  UNet net(testing::small_options());
  load_weights(*net, path());
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
  const Image highlight = unet().highlight(picture, clip, mask);
  for (int row = 0; row < 8; ++row) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(highlight(x, row, c), expected[c][row][x].item<float>(), 1e-5F);
    }
  }
}

TEST_F(HighlightNetTest, HostilePicturesStayWithinTheBound) {
  Image picture = random_picture(40, 24, -0.5F, 2);
  picture(3, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  picture(30, 20, 2) = std::numeric_limits<float>::infinity();
  picture(31, 20, 1) = -std::numeric_limits<float>::infinity();
  picture(8, 9, 1) = std::numeric_limits<float>::max();
  picture(9, 9, 1) = std::numeric_limits<float>::denorm_min();
  const ByteImage clip(40, 24, 1, 7);
  expect_within_picture(unet().highlight(picture, clip, {}), picture);
  expect_within_picture(mscr().highlight(picture, clip, {}), picture);
  const Image black(40, 24, 3);
  EXPECT_EQ(unet().highlight(black, {}, {}), black);
}

TEST_F(HighlightNetTest, NaNCountsAsBlack) {
  Image picture = random_picture(16, 16, 0, 1), black = picture;
  picture(3, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  black(3, 4, 0) = 0;
  const HighlightNet net = unet();
  EXPECT_EQ(net.highlight(picture, {}, {}), net.highlight(black, {}, {}));
}

TEST_F(HighlightNetTest, OutsideTheMaskThereIsNothing) {
  const HighlightNet net = unet();
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

TEST_F(HighlightNetTest, ClippingIsSeen) {
  const HighlightNet net = unet();
  const Image picture = random_picture(16, 16, 0.1F, 1);
  EXPECT_NE(net.highlight(picture, ByteImage(16, 16, 1, 7), {}), net.highlight(picture, {}, {}));
  EXPECT_NE(net.highlight(picture, ByteImage(16, 16, 1, 1), {}), net.highlight(picture, ByteImage(16, 16, 1, 4), {}));
}

TEST_F(HighlightNetTest, GreyGivesGrey) {
  Image grey = random_picture(20, 16, 0, 1);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 20; ++x) grey(x, y, 1) = grey(x, y, 2) = grey(x, y, 0);
  }
  Image nearly = grey;
  nearly(0, 0, 2) += 1e-6F;
  const auto expect_grey = [&](const HighlightNet& net) {
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
  };
  expect_grey(unet());
  expect_grey(mscr());
}

TEST_F(HighlightNetTest, MscrTakesAnySize) {
  const HighlightNet net = mscr();
  EXPECT_EQ(net.info().architecture, "mscr");
  const Image picture = random_picture(45, 70, 0, 1);
  const Image highlight = net.highlight(picture, {}, {});
  expect_within_picture(highlight, picture);
  EXPECT_GT(sum(highlight), 0);
}

TEST_F(HighlightNetTest, SetsTheThreadsOfTheProcess) {
  const HighlightNet two(path(), {.threads = 2});
  EXPECT_EQ(torch::get_num_threads(), 2);
  const HighlightNet all(path());
  EXPECT_EQ(torch::get_num_threads(), default_thread_count());
  torch::set_num_threads(1);
}

TEST_F(HighlightNetTest, WrongCallsAreRefused) {
  const HighlightNet net = unet();
  const Image picture(8, 8, 3);
  EXPECT_THROW(net.highlight(Image(8, 8, 1), {}, {}), std::invalid_argument);
  EXPECT_THROW(net.highlight(picture, ByteImage(8, 8, 3), {}), std::invalid_argument);
  EXPECT_THROW(net.highlight(picture, {}, ByteImage(8, 7, 1)), std::invalid_argument);
  expect_error(ExitCode::kUsage, {"threads", "-1"}, [&] { HighlightNet(path(), {.threads = -1}); });
  expect_error(ExitCode::kDevice, {"cuda:63"}, [&] { HighlightNet(path(), {.device = {.cuda = true, .index = 63}}); });
}

TEST_F(HighlightNetTest, FilesThatDoNotFitAreRefused) {
  const auto expect_refused = [&](const std::string& architecture, const std::string& options, const std::string& part) {
    save_weights(*UNet(testing::small_options()), path(), {{kArchitectureKey, architecture}, {kOptionsKey, options}},
                 true);
    expect_error(ExitCode::kModel, {part}, [&] { HighlightNet net(path()); });
  };
  expect_refused("resnet", "{}", "'resnet'");
  expect_refused("unet", "{}", "missing");
  expect_refused("unet", options_json(UNetOptions{}), "encoder.0");
  expect_refused("unet", options_json(UNetOptions{.in_channels = 3}), "3 channels in");
  expect_refused("mscr", R"({"mean":[0,0,0]})", "conv1.weight");
  expect_error(ExitCode::kModel, {"absent"}, [&] { HighlightNet(folder_ / "absent"); });
}

}  // namespace
}  // namespace faceprobe::net

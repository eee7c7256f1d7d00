#include "faceprobe/net/torch_highlight_net.h"

#include "faceprobe/core/parallel.h"
#include "net/fixtures.h"
#include "net/torch/weights.h"

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

class TorchHighlightNetTest : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }
  testing::TempFolder folder_;
};

TEST_F(TorchHighlightNetTest, MscrTakesAnySizeAndStaysWithinThePicture) {
  testing::write_mscr(path());
  const TorchHighlightNet net(path(), {.threads = 1});
  EXPECT_EQ(net.info().architecture, "mscr");
  const Image picture = random_picture(45, 70, 0, 1);
  const Image highlight = net.highlight(picture, {}, {});
  ASSERT_TRUE(highlight.same_size(picture));
  double sum = 0;
  for (std::size_t i = 0; i < highlight.values().size(); ++i) {
    ASSERT_GE(highlight.values()[i], 0);
    ASSERT_LE(highlight.values()[i], picture.values()[i]);
    sum += highlight.values()[i];
  }
  EXPECT_GT(sum, 0);
}

TEST_F(TorchHighlightNetTest, SetsTheThreadsOfTheProcess) {
  testing::write_unet(path(), testing::small_options());
  const TorchHighlightNet two(path(), {.threads = 2});
  EXPECT_EQ(torch::get_num_threads(), 2);
  const TorchHighlightNet all(path());
  EXPECT_EQ(torch::get_num_threads(), default_thread_count());
  torch::set_num_threads(1);
}

TEST_F(TorchHighlightNetTest, WhatDoesNotFitIsRefused) {
  testing::write_unet(path(), testing::small_options());
  expect_error(ExitCode::kDevice, {"cuda:63"},
               [&] { TorchHighlightNet(path(), {.device = {.cuda = true, .index = 63}}); });
  save_weights(*UNet(testing::small_options()), path(),
               {{kArchitectureKey, kMscrArchitecture}, {kOptionsKey, R"({"mean":[0,0,0]})"}}, true);
  expect_error(ExitCode::kModel, {"conv1.weight"}, [&] { TorchHighlightNet net(path()); });
}

}  // namespace
}  // namespace faceprobe::net

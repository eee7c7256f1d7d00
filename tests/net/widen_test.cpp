#include "net/torch/widen.h"

#include "net/fixtures.h"
#include "net/torch/weights.h"

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::small_options;

struct Narrow : public ::testing::Test {
  Narrow() {
    torch::manual_seed(3);
    testing::write_unet(path(), small_options());
    load_weights(*net, path());
  }
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }
  static UNetOptions doubled() {
    UNetOptions options = small_options();
    for (int& width : options.widths) width *= 2;
    return options;
  }

  testing::TempFolder folder_;
  UNet net{small_options()};
  torch::Tensor picture = torch::rand({2, 7, 16, 16});
  torch::NoGradGuard no_grad;
};

TEST_F(Narrow, AsWideAsBeforeIsTheSameBitForBit) {
  UNet other(small_options());
  load_widened(other, path());
  EXPECT_TRUE(torch::equal(other(picture), net(picture)));
}

// Every channel there twice in its group: the group's mean and variance are the same, and so is what comes out.
TEST_F(Narrow, TwiceAsWideSaysTheSame) {
  UNet wide(doubled());
  load_widened(wide, path(), 0);
  const torch::Tensor before = net(picture), after = wide(picture);
  EXPECT_LT((after - before).abs().max().item<double>(), 1e-4 * before.abs().max().item<double>());
}

TEST_F(Narrow, NoiseTellsTheCopiesApart) {
  UNet wide(doubled());
  load_widened(wide, path(), 0.1);
  const torch::Tensor weight = wide->named_parameters()["encoder.0.units.1.conv.weight"];
  // The first group's channels 0, 1, ... and their copies.
  const std::int64_t group = small_options().widths[0] / kNormGroups;
  EXPECT_FALSE(torch::equal(weight[0], weight[group]));
  EXPECT_LT((wide(picture) - net(picture)).abs().max().item<double>(), 0.5 * net(picture).abs().max().item<double>());
}

TEST_F(Narrow, FurtherOutputsLeaveTheOldOnesAlone) {
  UNetOptions more = small_options();
  more.out_channels += 3;
  UNet wide(more);
  load_widened(wide, path());
  EXPECT_TRUE(torch::allclose(wide(picture).narrow(1, 0, small_options().out_channels), net(picture), 1e-5, 1e-6));
}

TEST_F(Narrow, FurtherInputsCountForNothingAtFirst) {
  UNetOptions more = small_options();
  more.in_channels += 3;
  UNet wide(more);
  load_widened(wide, path());
  const torch::Tensor with_more = torch::cat({picture, torch::rand({2, 3, 16, 16})}, 1);
  EXPECT_TRUE(torch::allclose(wide(with_more), net(picture), 1e-5, 1e-6));
}

TEST_F(Narrow, RefusesWhatIsNarrower) {
  UNetOptions less = small_options();
  less.widths.pop_back();
  UNet other(less);
  expect_error(ExitCode::kModel, {"as many levels"}, [&] { load_widened(other, path()); });
}

}  // namespace
}  // namespace faceprobe::net

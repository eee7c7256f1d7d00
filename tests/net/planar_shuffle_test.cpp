#include "net/torch/planar_shuffle.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include <cstdint>

namespace faceprobe::net {
namespace {

torch::Tensor features(std::uint64_t seed, torch::MemoryFormat order) {
  torch::manual_seed(seed);
  return torch::randn({3, 5 * 4, 7, 6}).contiguous(order);
}

TEST(PlanarShuffle, HasLibtorchsNumbersPlaneByPlane) {
  for (const auto order : {torch::MemoryFormat::Contiguous, torch::MemoryFormat::ChannelsLast}) {
    const torch::Tensor x = features(1, order);
    const torch::Tensor planes = planar_pixel_shuffle(x, 2);
    EXPECT_TRUE(torch::equal(planes, torch::pixel_shuffle(x, 2)));
    EXPECT_TRUE(planes.is_contiguous());
  }
  const torch::Tensor x = torch::randn({1, 18, 2, 3});
  EXPECT_TRUE(torch::equal(planar_pixel_shuffle(x, 3), torch::pixel_shuffle(x, 3)));
}

// A shuffle is its own transpose's inverse, so that the gradients are the same numbers, not only near ones.
TEST(PlanarShuffle, HasLibtorchsGradient) {
  const torch::Tensor weight = torch::randn({3, 5, 14, 12});
  torch::Tensor ours = features(2, torch::MemoryFormat::ChannelsLast).requires_grad_();
  torch::Tensor theirs = features(2, torch::MemoryFormat::ChannelsLast).requires_grad_();
  (planar_pixel_shuffle(ours, 2) * weight).sum().backward();
  (torch::pixel_shuffle(theirs, 2) * weight).sum().backward();
  EXPECT_TRUE(torch::equal(ours.grad(), theirs.grad()));
  EXPECT_TRUE(ours.grad().is_contiguous(torch::MemoryFormat::ChannelsLast));
}

TEST(PlanarShuffle, LeavesDoublesAndWhatDoesNotDivideToLibtorch) {
  const torch::Tensor x = torch::randn({1, 8, 2, 2}, torch::kDouble);
  EXPECT_TRUE(torch::equal(planar_pixel_shuffle(x, 2), torch::pixel_shuffle(x, 2)));
  EXPECT_THROW(planar_pixel_shuffle(torch::randn({1, 6, 2, 2}), 2), c10::Error);
}

}  // namespace
}  // namespace faceprobe::net

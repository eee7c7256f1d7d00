#include "synth/light/blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace faceprobe::synth {
namespace {

TEST(Blur, KernelHasTheVarianceThatWasAskedFor) {
  for (const float deviation : {0.05F, 0.3F, 0.5F, 1.0F, 2.5F, 8.0F, 24.0F}) {
    const std::vector<float> kernel = gaussian_kernel(deviation);
    double sum = kernel[0];
    double variance = 0;
    for (std::size_t k = 1; k < kernel.size(); ++k) {
      sum += 2.0 * kernel[k];
      variance += 2.0 * static_cast<double>(k * k) * kernel[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-6) << deviation;  // float weights
    // The ends that are cut hold 1e-4 of the weight at about four deviations: 1e-4 * 4^2 of the variance; more for a kernel of
    // one or two taps, where all of the cut weight is a tap away.
    const double expected = static_cast<double>(deviation) * static_cast<double>(deviation);
    EXPECT_NEAR(variance, expected, 2.5e-3 * expected + 2e-4) << deviation;
  }
}

TEST(Blur, NoBlurIsNoChange) {
  EXPECT_EQ(gaussian_kernel(0.0F), std::vector<float>{1.0F});
  std::vector<float> plane = {1, 2, 3, 4, 5, 6};
  blur_plane(plane.data(), 3, 2, gaussian_kernel(0.0F));
  EXPECT_EQ(plane, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST(Blur, KeepsTheSumAlsoAtEdgesAndInPicturesSmallerThanTheKernel) {
  for (const int width : {1, 3, 17, 40}) {
    const int height = 5;
    std::vector<float> plane(static_cast<std::size_t>(width * height), 0.0F);
    plane.front() = 100;
    plane.back() = 7;
    blur_plane(plane.data(), width, height, gaussian_kernel(3.0F));
    EXPECT_NEAR(std::accumulate(plane.begin(), plane.end(), 0.0), 107.0, 1e-3) << width;  // float sums
  }
}

TEST(Blur, TwoBlursAreOneOfTheSumOfVariances) {
  const int side = 41;
  std::vector<float> twice(side * side, 0.0F);
  twice[20 * side + 20] = 1;
  std::vector<float> once = twice;
  blur_plane(twice.data(), side, side, gaussian_kernel(0.6F));
  blur_plane(twice.data(), side, side, gaussian_kernel(0.8F));
  blur_plane(once.data(), side, side, gaussian_kernel(1.0F));
  // The discrete Gaussians form a semigroup; what is left is the 1e-4 cut from each kernel.
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], once[i], 1e-4);
}

}  // namespace
}  // namespace faceprobe::synth

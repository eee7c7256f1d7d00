// SSIM against its definition, and where it has a closed form.
#include "faceprobe/eval/image_metrics.h"

#include "eval/pictures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::eval::testing {
namespace {

constexpr double kC1 = 1e-4;
constexpr double kC2 = 9e-4;

// Equations 13 to 16 of the paper, window by window, with variances about the mean.
double direct_ssim(const Image& a, const Image& b, const ByteImage& mask = {}) {
  double total = 0;
  int count = 0;
  for (int y = 5; y < a.height() - 5; ++y) {
    for (int x = 5; x < a.width() - 5; ++x) {
      if (!mask.empty() && mask(x, y) == 0) continue;
      for (int c = 0; c < a.channels(); ++c) {
        const auto window_mean = [&](const auto& value) {
          double sum = 0;
          double weights = 0;
          for (int v = -5; v <= 5; ++v) {
            for (int u = -5; u <= 5; ++u) {
              const double weight = std::exp(-(u * u + v * v) / (2 * 1.5 * 1.5));
              sum += weight * value(static_cast<double>(a(x + u, y + v, c)), static_cast<double>(b(x + u, y + v, c)));
              weights += weight;
            }
          }
          return sum / weights;
        };
        const double mean_a = window_mean([](double p, double) { return p; });
        const double mean_b = window_mean([](double, double q) { return q; });
        const double var_a = window_mean([&](double p, double) { return (p - mean_a) * (p - mean_a); });
        const double var_b = window_mean([&](double, double q) { return (q - mean_b) * (q - mean_b); });
        const double cov = window_mean([&](double p, double q) { return (p - mean_a) * (q - mean_b); });
        total += (2 * mean_a * mean_b + kC1) * (2 * cov + kC2) /
                 ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
        ++count;
      }
    }
  }
  return total / count;
}

// Half of it follows the other picture, so that the likeness is neither 0 nor 1.
Image related(const Image& other, std::uint64_t seed) {
  Image out = noise(other.width(), other.height(), other.channels(), seed);
  for (std::size_t i = 0; i < out.values().size(); ++i) {
    out.values()[i] = 0.5F * out.values()[i] + 0.5F * other.values()[i];
  }
  return out;
}

TEST(Ssim, AgreesWithTheDirectSum) {
  for (const int channels : {1, 3}) {
    const Image a = noise(31, 24, channels, 1);
    const Image b = related(a, 2);
    EXPECT_NEAR(ssim(a, b), direct_ssim(a, b), 1e-12);
    EXPECT_NEAR(ssim(a, b, left_half(31, 24)), direct_ssim(a, b, left_half(31, 24)), 1e-12);
    EXPECT_GT(std::abs(ssim(a, b) - ssim(a, b, left_half(31, 24))), 1e-4);
  }
}

TEST(Ssim, KeepsItsDigitsOnBrightLayers) {
  // Windows of mean 100 and deviation .03: the variance is 1e-7 of the squares that it is the difference of.
  const Image a = affine(noise(24, 24, 3, 1), 0.1F, 100);
  const Image b = affine(noise(24, 24, 3, 2), 0.1F, 100);
  EXPECT_NEAR(ssim(a, b), direct_ssim(a, b), 1e-7);
}

TEST(Ssim, OfConstantPicturesIsTheLuminanceTerm) {
  const double a = 0.25;
  const double b = 0.75;
  const double expected = (2 * a * b + kC1) / (a * a + b * b + kC1);
  EXPECT_NEAR(ssim(Image(20, 15, 3, 0.25F), Image(20, 15, 3, 0.75F)), expected, 1e-12);
  EXPECT_NEAR(ssim(Image(11, 11, 1), Image(11, 11, 1, 0.75F)), kC1 / (b * b + kC1), 1e-12);
}

TEST(Ssim, OfThePictureItselfIsOneAndItIsSymmetric) {
  const Image a = noise(40, 30, 3, 1);
  const Image b = related(a, 2);
  EXPECT_NEAR(ssim(a, a), 1, 1e-12);
  EXPECT_NEAR(ssim(a, b), ssim(b, a), 1e-14);
  EXPECT_LT(ssim(a, b), 0.95);
}

TEST(Ssim, OfANegativeIsTheStructureTermTurned) {
  // Around the mean 1/2 a negative has the same mean and variance and the covariance of the opposite sign, so the mean
  // over windows lies between -1 and 0, short of -1 only by the local means and the constants.
  const Image a = noise(60, 60, 1, 3);
  EXPECT_LT(ssim(a, affine(a, -1, 1)), -0.9);
}

TEST(Ssim, MeanOverChannels) {
  const Image grey = noise(30, 30, 1, 1);
  const Image other = related(grey, 2);
  Image a(30, 30, 3, 0.5F);
  Image b(30, 30, 3, 0.5F);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 30; ++x) {
      a(x, y, 1) = grey(x, y);
      b(x, y, 1) = other(x, y);
    }
  }
  EXPECT_NEAR(ssim(a, b), (2 + ssim(grey, other)) / 3, 1e-12);  // the flat channels agree
}

TEST(Ssim, NeedsRoomForAWindow) {
  EXPECT_TRUE(std::isnan(ssim(Image(10, 40, 3), Image(10, 40, 3))));
  EXPECT_NEAR(ssim(Image(11, 11, 3), Image(11, 11, 3)), 1, 1e-12);
  ByteImage border(30, 30, 1);
  border(2, 15) = 1;  // no window has its centre there
  EXPECT_TRUE(std::isnan(ssim(Image(30, 30, 3), Image(30, 30, 3), border)));
}

}  // namespace
}  // namespace faceprobe::eval::testing

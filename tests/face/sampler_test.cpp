#include "face/sampler.h"

#include "faceprobe/core/color.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <numbers>

namespace faceprobe::face {
namespace {

std::vector<float> sample(const Sampler& sampler, const SquareRegion& square, int size, float low = 0, float high = 1) {
  std::vector<float> out(static_cast<std::size_t>(size * size * 3));
  sampler.sample(square, size, low, high, out.data());
  return out;
}

TEST(Sampler, PixelForPixelItEncodes) {
  Image image(8, 8, 3);
  for (std::size_t i = 0; i < image.values().size(); ++i) image.data()[i] = static_cast<float>(i) / 200;
  const std::vector<float> out = sample(Sampler(image), {{4, 4}, 8, 0}, 8);
  for (std::size_t i = 0; i < out.size(); ++i)
    EXPECT_NEAR(out[i], srgb_from_linear(image.data()[i]), 5e-4);  // table steps
}

TEST(Sampler, RangeGreyAndOutside) {
  const Image grey(4, 4, 1, 1.0F);
  const std::vector<float> out = sample(Sampler(grey), {{4, 2}, 4, 0}, 4, -1, 1);
  EXPECT_FLOAT_EQ(out[0], 1);
  EXPECT_FLOAT_EQ(out[2], 1);
  EXPECT_FLOAT_EQ(out[3 * 3], -1) << "beyond the right edge";
}

TEST(Sampler, TurnsClockwise) {
  Image image(9, 9, 1);
  image(4, 0) = 1;  // middle of the top edge
  SquareRegion square{{4.5F, 4.5F}, 9, static_cast<float>(std::numbers::pi / 2)};
  const std::vector<float> out = sample(Sampler(image), square, 9);
  // The square's x axis points down in the photo, its y axis to the left: the photo's top is the square's left side.
  EXPECT_NEAR(out[(4 * 9 + 0) * 3], 1, 0.05);
  const Eigen::Vector2f top = square.photo_from_unit(0, 0.5F);
  EXPECT_NEAR((top - Eigen::Vector2f(4.5F, 0)).norm(), 0, 1e-5);
}

TEST(Sampler, ShrinkingAveragesLight) {
  // A checkerboard of black and white is half of the light, whatever the phase: selection would give 0 or 1.
  Image board(1024, 1024, 1);
  for (int y = 0; y < 1024; ++y) {
    for (int x = 0; x < 1024; ++x) board(x, y) = static_cast<float>((x + y) % 2);
  }
  for (const float value : sample(Sampler(board), {{510, 505}, 700, 0.3F}, 64))
    EXPECT_NEAR(value, srgb_from_linear(0.5F), 0.02);
}

TEST(Sampler, ShrinkingStaysInPlace) {
  // The centre of light of a small square survives three halvings to a tenth of a sample.
  Image image(1001, 777, 1);
  for (int y = 300; y < 364; ++y) {
    for (int x = 500; x < 564; ++x) image(x, y) = 1;
  }
  const std::vector<float> out = sample(Sampler(image), {{532, 332}, 640, 0}, 64);
  double sum = 0;
  double sx = 0;
  double sy = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double light = static_cast<double>(linear_from_srgb(out[static_cast<std::size_t>((y * 64 + x) * 3)]));
      sum += light;
      sx += light * (x + 0.5);
      sy += light * (y + 0.5);
    }
  }
  EXPECT_NEAR(sx / sum, 32, 0.1);
  EXPECT_NEAR(sy / sum, 32, 0.1);
}

// Light of a picture whose left half is `level` and whose right half a quarter of it, as the exposed sampler shows both.
std::array<float, 2> exposed_halves(float level) {
  Image halves(100, 80, 3, level);
  for (int y = 0; y < halves.height(); ++y) {
    for (int x = 50; x < halves.width(); ++x) std::fill_n(halves.pixel(x, y), 3, level / 4);
  }
  Sampler sampler(halves);
  sampler.expose();
  const std::vector<float> out = sample(sampler, {{50, 40}, 80, 0}, 16);
  const auto at = [&](std::size_t x) { return linear_from_srgb(out[(8 * 16 + x) * 3]); };
  return {at(2), at(13)};
}

TEST(Sampler, ExposureBringsDarkAndBrightPicturesIntoRange) {
  for (const float level : {0.001F, 0.05F, 20.0F}) {
    const auto [bright, dim] = exposed_halves(level);
    EXPECT_GE(bright, 0.29F) << level;
    EXPECT_NEAR(dim, bright / 4, 0.01F) << level << ": burnt out";
  }
  EXPECT_NEAR(exposed_halves(0.7F)[0], 0.7F, 0.005F) << "well exposed as it is";
  EXPECT_EQ(exposed_halves(0)[0], 0);
}

}  // namespace
}  // namespace faceprobe::face

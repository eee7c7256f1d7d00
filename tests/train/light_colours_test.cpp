#include "train/light_colours.h"

#include "train/finetune_guards.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kSize = 96;

// Skin with red cheeks under a shading that turns with `turn`, of lights that are `warm` on the left and as cold on the right.
SquarePhoto photo(float turn, float warm = 0) {
  SquarePhoto out{Image(kSize, kSize, 3), ByteImage(kSize, kSize, 1, 1)};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float u = static_cast<float>(x) / (kSize - 1) - 0.5F;
      const float v = static_cast<float>(y) / (kSize - 1) - 0.5F;
      const float red = 1 + 0.3F * std::exp(-20 * ((std::abs(u) - 0.25F) * (std::abs(u) - 0.25F) + v * v));
      const float shading = 0.5F + 0.3F * (u * std::cos(turn) + v * std::sin(turn));
      out.linear(x, y, 0) = shading * 0.5F * red * (1 - warm * u);
      out.linear(x, y, 1) = shading * 0.31F;
      out.linear(x, y, 2) = shading * 0.22F * (1 + warm * u);
    }
  }
  return out;
}

TEST(LightColours, SkinsColoursExposureAndWhiteBalanceAreNoLight) {
  std::vector<SquarePhoto> photos;
  for (int k = 0; k < 4; ++k) {
    photos.push_back(photo(static_cast<float>(k)));
    for (std::size_t i = 0; i < photos.back().linear.pixel_count(); ++i) {
      photos.back().linear.data()[3 * i] *= 1 + 0.2F * static_cast<float>(k);
      photos.back().linear.data()[3 * i + 2] *= 1 - 0.1F * static_cast<float>(k);
    }
  }
  for (const double spread : light_colour_spreads(photos)) EXPECT_LT(spread, 1e-3);  // shades differ within a block
}

TEST(LightColours, ThePhotoOfTwoLightsIsTheOneThatHasThem) {
  std::vector<SquarePhoto> photos;
  for (int k = 0; k < 5; ++k) photos.push_back(photo(static_cast<float>(k), k == 2 ? 1.0F : 0.0F));
  const std::vector<double> spreads = light_colour_spreads(photos);
  // Shares of (1 - u, 1, 1 + u) / 3 over u in [-.5, .5]: only red differs in (r, g), by 1/3 of u's deviation of 1/sqrt(12), and the others
  // are the mean's four fifths. Weights and the blocks' width change it by a few hundredths of itself.
  const double expected = 4.0 / 5 / 3 / std::sqrt(12.0);
  EXPECT_NEAR(spreads[2], expected, 0.1 * expected);
  for (const std::size_t k : {0U, 1U, 3U, 4U}) EXPECT_LT(spreads[k], 0.3 * spreads[2]) << k;
  EXPECT_GT(spreads[2], PhotoLimits{}.max_light_colour_spread);
  photos.erase(photos.begin() + 2);
  for (const double spread : light_colour_spreads(photos)) EXPECT_LT(spread, 1e-3);
}

TEST(LightColours, AHighlightIsNoLightColour) {
  std::vector<SquarePhoto> photos(4, photo(0));
  // Lines of white as bright as the skin, on a third of each block of 6 pixels.
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize / 2; x += 3)
      for (int c = 0; c < 3; ++c) photos[1].linear(x, y, c) += 0.3F;
  EXPECT_LT(light_colour_spreads(photos)[1], PhotoLimits{}.max_light_colour_spread / 3);
}

TEST(LightColours, WhatIsNotShownSaysNothing) {
  std::vector<SquarePhoto> photos = {photo(0, 1), photo(0)};
  EXPECT_GT(light_colour_spreads(photos)[0], 0.02);
  photos[1].usable = ByteImage(kSize, kSize, 1);
  EXPECT_EQ(light_colour_spreads(photos)[0], 0) << "nothing to compare with";
  EXPECT_EQ(light_colour_spreads({photos[0]})[0], 0);
  EXPECT_TRUE(light_colour_spreads({}).empty());
  photos[1].usable = ByteImage(4, 4, 1);
  EXPECT_THROW(light_colour_spreads(photos), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train

#include "faceprobe/insert/photo_look.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::insert {
namespace {

constexpr int kSide = 512;
// A level holds about 200 blocks of 250 pixels, so chance is below 1 %; the rest is that the densest place of their variances lies
// a little low, and that a level is as wide as .2 of brightness.
constexpr float kTolerance = 0.06F;

Grain even_grain(float sigma) {
  Grain grain;
  grain.sigma.fill(sigma);
  return grain;
}

// Encoded brightness rises from `low` to `high` across the picture.
Image ramp(float low, float high, int channels) {
  Image picture(kSide, kSide, channels);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float light = linear_from_srgb(low + (high - low) * static_cast<float>(x) / kSide);
      for (int c = 0; c < channels; ++c) picture(x, y, c) = light;
    }
  }
  return picture;
}

// White, the same in each channel, made without add_grain.
void add_white_noise(Image& picture, float dark, float bright) {
  Random random({11});
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float encoded = srgb_from_linear(picture(x, y, 0));
      const float noisy = encoded + (dark + (bright - dark) * encoded) * static_cast<float>(random.normal());
      for (int c = 0; c < picture.channels(); ++c) picture(x, y, c) = linear_from_srgb(noisy);
    }
  }
}

void add_everywhere(Image& picture, const Grain& grain, std::uint64_t seed) {
  add_grain(picture, Image(picture.width(), picture.height(), 1, 1.0F), grain, seed);
}

void expect_close(const Grain& found, const Grain& truth) {
  for (std::size_t i = 0; i < truth.sigma.size(); ++i) {
    // A block holds fewer independent values of soft grain, so the low end of the variances lies lower.
    const float tolerance = kTolerance + 0.04F * truth.correlation_px;
    EXPECT_NEAR(found.sigma[i], truth.sigma[i], tolerance * truth.sigma[i]) << i;
  }
  // The sum over some 10^5 pixels; below .2 px a Gaussian hardly reaches the next pixel.
  EXPECT_NEAR(found.correlation_px, truth.correlation_px, truth.correlation_px > 0.2F ? 0.05F : 0.2F);
  EXPECT_NEAR(found.colour, truth.colour, 0.05F * truth.colour + 1e-3F);
}

TEST(EstimateGrain, FindsTheSigmaOfWhiteNoise) {
  for (const float sigma : {0.003F, 0.01F, 0.03F}) {
    Image picture = ramp(0.15F, 0.85F, 1);
    add_white_noise(picture, sigma, sigma);
    expect_close(estimate_grain(picture), even_grain(sigma));
  }
}

TEST(EstimateGrain, FollowsTheBrightness) {
  Image picture = ramp(0.1F, 0.95F, 3);
  add_white_noise(picture, 0.02F, 0.005F);
  const Grain found = estimate_grain(picture);
  for (const float brightness : {0.2F, 0.3F, 0.5F, 0.7F, 0.9F}) {
    EXPECT_NEAR(found.sigma_at(brightness), 0.02F - 0.015F * brightness, 0.0012F) << brightness;
  }
  EXPECT_LT(found.colour, 1e-3F);
}

TEST(EstimateGrain, DoesNotCountTexture) {
  Image picture = ramp(0.3F, 0.7F, 1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (y % 192 >= 64)
        picture(x, y) *= 1 + 0.3F * std::sin(0.9F * static_cast<float>(x) + 0.5F * static_cast<float>(y));
    }
  }
  add_white_noise(picture, 0.01F, 0.01F);
  EXPECT_NEAR(estimate_grain(picture).sigma_at(0.5F), 0.01F, 0.001F);
}

TEST(EstimateGrain, PassesOverClippedAndPaintedAreas) {
  Image picture = ramp(0.2F, 0.8F, 1);
  add_white_noise(picture, 0.01F, 0.01F);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (y < 100) picture(x, y) = 1;
      if (y >= 100 && y < 200) picture(x, y) = 0;
      if (y >= 200 && y < 280) picture(x, y) = 0.3F;
    }
  }
  picture(300, 300) = std::numeric_limits<float>::quiet_NaN();
  expect_close(estimate_grain(picture), even_grain(0.01F));
  EXPECT_EQ(estimate_grain(Image(64, 64, 3, 1.0F)).sigma_at(0.5F), 0);
}

TEST(EstimateGrain, IsZeroWithoutNoise) {
  EXPECT_EQ(estimate_grain(Image(256, 256, 3, 0.2F)).sigma, even_grain(0).sigma);
  for (const float sigma : estimate_grain(ramp(0.1F, 0.9F, 3)).sigma) EXPECT_LT(sigma, 1e-5F);
  EXPECT_EQ(estimate_grain({}).sigma, even_grain(0).sigma);
}

TEST(AddGrain, EstimateGivesItBack) {
  Grain grain{.sigma = {0.012F, 0.01F, 0.008F, 0.006F, 0.005F}};
  for (const float correlation : {0.0F, 0.6F, 1.2F}) {
    for (const float colour : {0.0F, 0.5F, 1.4F}) {
      grain.correlation_px = correlation;
      grain.colour = colour;
      grain.colour_correlation_px = correlation + 0.3F;
      Image picture = ramp(0.05F, 0.95F, 3);
      add_everywhere(picture, grain, 7);
      expect_close(estimate_grain(picture), grain);
    }
  }
}

TEST(AddGrain, LeavesTheRestAlone) {
  const Image before = ramp(0.1F, 0.9F, 3);
  Image where(kSide, kSide, 1);
  for (int y = 40; y < 90; ++y) {
    for (int x = 30; x < 80; ++x) where(x, y) = 0.5F;
  }
  Image after = before;
  add_grain(after, where, even_grain(0.02F), 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) ASSERT_EQ(after(x, y, 1) != before(x, y, 1), where(x, y) > 0) << x << ' ' << y;
  }
  Image same = before;
  add_grain(same, where, Grain{}, 3);
  EXPECT_EQ(same, before);
}

TEST(AddGrain, HangsOnThePlaceAndTheSeedAlone) {
  Grain grain = even_grain(0.02F);
  grain.correlation_px = 0.8F;
  grain.colour = 1;
  const Image plain(60, 50, 3, 0.3F);
  Image whole = plain;
  Image again = plain;
  Image part = plain;
  Image other = plain;
  Image where(60, 50, 1);
  where(31, 17) = 1;
  add_everywhere(whole, grain, 5);
  add_everywhere(again, grain, 5);
  add_everywhere(other, grain, 6);
  add_grain(part, where, grain, 5);
  EXPECT_EQ(whole, again);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(part(31, 17, c), whole(31, 17, c));
  EXPECT_NE(whole, other);
}

TEST(AddGrain, KeepsLightInBounds) {
  Image picture(64, 64, 3, 0.0F);
  picture(3, 3, 1) = std::numeric_limits<float>::infinity();
  add_everywhere(picture, even_grain(0.05F), 1);
  for (const float value : picture.values()) EXPECT_GE(value, 0);
  EXPECT_EQ(picture(3, 3, 0), 0);
  EXPECT_TRUE(std::isinf(picture(3, 3, 1)));
}

TEST(AddGrain, RefusesWhatDoesNotFit) {
  Image picture(8, 8, 3);
  EXPECT_THROW(add_grain(picture, Image(8, 7, 1), {}, 1), std::invalid_argument);
  EXPECT_THROW(add_grain(picture, Image(8, 8, 3), {}, 1), std::invalid_argument);
  EXPECT_THROW(add_grain(picture, Image(8, 8, 1), even_grain(-1), 1), std::invalid_argument);
  EXPECT_THROW(add_grain(picture, Image(8, 8, 1), even_grain(std::nanf("")), 1), std::invalid_argument);
  EXPECT_THROW(add_grain(picture, Image(8, 8, 1), Grain{.correlation_px = 17}, 1), std::invalid_argument);
  EXPECT_THROW(estimate_grain(Image(32, 32, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::insert

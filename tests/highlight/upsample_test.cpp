#include "faceprobe/highlight/upsample.h"

#include "faceprobe/core/error.h"
#include "highlight/pictures.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <utility>

namespace faceprobe::highlight::testing {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Mean over squares of `factor` pixels.
Image shrink(const Image& full, int factor) {
  Image small(full.width() / factor, full.height() / factor, 3);
  const float share = 1 / static_cast<float>(factor * factor);
  for (int y = 0; y < small.height() * factor; ++y) {
    for (int x = 0; x < small.width() * factor; ++x) {
      for (int c = 0; c < 3; ++c) small(x / factor, y / factor, c) += share * full(x, y, c);
    }
  }
  return small;
}

Image bilinear(const Image& small, int width, int height) {
  Image full(width, height, 3);
  const auto place = [](int i, int size, int small_size) {
    const float at = (static_cast<float>(i) + 0.5F) * static_cast<float>(small_size) / static_cast<float>(size) - 0.5F;
    return std::clamp(at, 0.0F, static_cast<float>(small_size - 1));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = place(x, width, small.width());
      const float v = place(y, height, small.height());
      const int u0 = std::min(static_cast<int>(u), small.width() - 2);
      const int v0 = std::min(static_cast<int>(v), small.height() - 2);
      const float s = u - static_cast<float>(u0);
      const float t = v - static_cast<float>(v0);
      for (int c = 0; c < 3; ++c) {
        full(x, y, c) = (1 - t) * ((1 - s) * small(u0, v0, c) + s * small(u0 + 1, v0, c)) +
                        t * ((1 - s) * small(u0, v0 + 1, c) + s * small(u0 + 1, v0 + 1, c));
      }
    }
  }
  return full;
}

// Values in [.5, 1).
Image bright_noise(int width, int height, unsigned seed) {
  Image image = noise(width, height, seed);
  for (float& value : image.values()) value = 0.5F + 0.5F * value;
  return image;
}

// Between 0 and the picture for every picture of bright_noise().
Image affine_highlight(const Image& picture) {
  Image out = black_like(picture);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const float* p = picture.pixel(x, y);
      out(x, y, 0) = 0.30F * p[0] - 0.20F * p[1] + 0.10F * p[2] + 0.10F;
      out(x, y, 1) = 0.05F * p[0] + 0.25F * p[1] - 0.15F * p[2] + 0.08F;
      out(x, y, 2) = 0.20F * p[0] + 0.10F * p[1] + 0.10F * p[2] + 0.02F;
    }
  }
  return out;
}

double largest_difference(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(a.values()[i]) - b.values()[i]));
  }
  return most;
}

TEST(Upsample, FindsAnAffineFunctionOfTheColour) {
  const Image small = bright_noise(24, 18, 1);
  for (const auto& [width, height] : {std::pair{96, 72}, {101, 50}, {24, 18}}) {
    const Image full = bright_noise(width, height, 2);  // of its own: the function is all that is carried over
    const Image found = upsample_highlight(affine_highlight(small), small, full, {}, {.epsilon = 1e-9F});
    // epsilon over the variance, .02, is 5e-8; models and colours are floats near 1.
    EXPECT_LT(largest_difference(found, affine_highlight(full)), 2e-6) << width;
  }
}

TEST(Upsample, KeepsAConstantHighlight) {
  const Image small = bright_noise(20, 20, 3);
  const Image full = bright_noise(77, 90, 4);
  EXPECT_LT(largest_difference(upsample_highlight(Image(20, 20, 3, 0.25F), small, full), Image(77, 90, 3, 0.25F)), 1e-6);
  EXPECT_EQ(largest(upsample_highlight(Image(20, 20, 3), small, full)), 0);
}

TEST(Upsample, OfAFlatPictureInterpolatesTheMeanOfWindows) {
  // Nothing to learn: the models are means over windows twice, which keep a ramp away from the borders, and between pixels
  // the ramp goes on.
  Image ramp(40, 20, 3);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int c = 0; c < 3; ++c) ramp(x, y, c) = 0.01F * (static_cast<float>(x) + 0.5F);
    }
  }
  const Image found = upsample_highlight(ramp, Image(40, 20, 3, 0.5F), Image(160, 80, 3, 0.5F), {}, {.radius_px = 3});
  for (int x = 28; x < 132; ++x) ASSERT_NEAR(found(x, 40, 1), 0.0025F * (static_cast<float>(x) + 0.5F), 1e-6F);
}

TEST(Upsample, StaysBetweenZeroAndThePicture) {
  const Image small = noise(16, 16, 5);
  Image full = noise(64, 64, 6);
  for (int x = 0; x < 64; ++x) full(x, 9, 1) = -0.1F;  // sensors do that
  const Image found = upsample_highlight(noise(16, 16, 7), small, full, {}, {.radius_px = 1});
  int at_zero = 0;
  int at_picture = 0;
  for (std::size_t i = 0; i < full.values().size(); ++i) {
    ASSERT_GE(found.values()[i], 0);
    ASSERT_LE(found.values()[i], std::max(0.0F, full.values()[i]));
    at_zero += found.values()[i] == 0;
    at_picture += found.values()[i] == full.values()[i];
  }
  EXPECT_GT(at_zero, 100);  // both bounds were needed
  EXPECT_GT(at_picture, 100);
}

// Skin in smooth shading with brown spots of albedo, and a lobe that pores of three pixels break up.
struct Skin {
  Image picture{256, 256, 3};
  Image highlight{256, 256, 3};
};
Skin skin_with_pores() {
  const Image pores = bilinear(noise(86, 86, 1), 256, 256);
  const Image spots = bilinear(noise(40, 40, 2), 256, 256);
  Skin skin;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const float u = (static_cast<float>(x) - 100) / 256;
      const float v = (static_cast<float>(y) - 110) / 256;
      const float lobe = 0.4F * std::exp(-12 * (u * u + v * v)) * (0.2F + 0.8F * pores(x, y));
      const float shading = 1 - u * u - v * v;
      const float melanin = 0.9F + 0.2F * spots(x, y);
      const Colour albedo = {0.5F * std::pow(melanin, 0.7F), 0.3F * melanin, 0.22F * std::pow(melanin, 1.3F)};
      for (int c = 0; c < 3; ++c) {
        skin.highlight(x, y, c) = lobe;
        skin.picture(x, y, c) = lobe + shading * albedo[static_cast<std::size_t>(c)];
      }
    }
  }
  return skin;
}

TEST(Upsample, KeepsPoresSharp) {
  const Skin skin = skin_with_pores();
  for (const int factor : {4, 8}) {
    const Image small = shrink(skin.highlight, factor);
    const double guided = rms(upsample_highlight(small, shrink(skin.picture, factor), skin.picture), skin.highlight);
    const double blurred = rms(bilinear(small, 256, 256), skin.highlight);
    // Measured, of 255: 1.62 against 3.75 for a factor of 4, 1.80 against 5.08 for 8. What is left are the spots, whose
    // colour is not in one plane with that of the highlight.
    EXPECT_LT(guided, 0.5 * blurred) << factor << ": " << 255 * guided << " of " << 255 * blurred;
  }
}

TEST(Upsample, LearnsAndWritesInsideTheMaskOnly) {
  const Image small = bright_noise(24, 24, 1);
  const Image full = bright_noise(96, 96, 2);
  Image highlight = affine_highlight(small);
  ByteImage mask(96, 96, 1);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 48; ++x) mask(x, y) = 255;
  }
  for (int y = 0; y < 24; ++y) {
    for (int x = 12; x < 24; ++x) highlight(x, y, 0) = 7;  // would spoil the models left of it
  }
  const Image found = upsample_highlight(highlight, small, full, mask, {.epsilon = 1e-9F});
  const Image expected = affine_highlight(full);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(found(x, y, c), x < 48 ? expected(x, y, c) : 0.0F, 2e-6F) << x << ' ' << y;
    }
  }
  EXPECT_EQ(largest(upsample_highlight(highlight, small, full, ByteImage(96, 96, 1))), 0);
}

TEST(Upsample, ValuesThatAreNoNumbersStayWhereTheyAre) {
  Image small = bright_noise(24, 18, 1);
  Image full = bright_noise(96, 72, 2);
  Image highlight = affine_highlight(small);
  const Image expected = affine_highlight(full);
  small(3, 4, 1) = kNan;
  small(12, 9, 0) = kInfinity;
  highlight(20, 10, 2) = -kInfinity;
  full(50, 30, 0) = kNan;
  full(51, 30, 2) = kInfinity;
  const Image found = upsample_highlight(highlight, small, full, {}, {.epsilon = 1e-9F});
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 96; ++x) {
      const bool no_number = y == 30 && (x == 50 || x == 51);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(found(x, y, c), no_number ? 0.0F : expected(x, y, c), 2e-6F) << x << ' ' << y;
    }
  }
  EXPECT_EQ(largest(upsample_highlight(highlight, Image(24, 18, 3, kNan), full)), 0);
}

TEST(Upsample, AbsurdValuesGiveValuesInBounds) {
  const Image full(40, 40, 3, 0.5F);
  for (const float size : {1e15F, 1e30F, 3e38F}) {
    Image small = noise(10, 10, 1);
    for (float& value : small.values()) value *= size;
    const Image found = upsample_highlight(small, small, full);
    for (const float value : found.values()) {
      ASSERT_GE(value, 0);
      ASSERT_LE(value, 0.5F);
    }
  }
}

TEST(Upsample, GivesTheSameForAnyNumberOfThreads) {
  const Skin skin = skin_with_pores();
  const Image small = shrink(skin.picture, 4);
  const Image highlight = shrink(skin.highlight, 4);
  const Image one = upsample_highlight(highlight, small, skin.picture, {}, {.threads = 1});
  for (const int threads : {2, 3, 7, 300}) {
    EXPECT_EQ(upsample_highlight(highlight, small, skin.picture, {}, {.threads = threads}), one);
  }
}

TEST(Upsample, TakesTheSmallestPictures) {
  const Image found = upsample_highlight(Image(1, 1, 3, 0.25F), Image(1, 1, 3, 0.5F), Image(5, 3, 3, 0.5F));
  EXPECT_LT(largest_difference(found, Image(5, 3, 3, 0.25F)), 1e-6);
  EXPECT_EQ(upsample_highlight(Image(2, 2, 3), Image(2, 2, 3), Image(1, 1, 3, 0.5F)).width(), 1);
  EXPECT_TRUE(upsample_highlight({}, {}, Image(0, 0, 3)).empty());
}

TEST(Upsample, RefusesWhatDoesNotFit) {
  const Image small(8, 8, 3);
  const Image full(32, 32, 3);
  EXPECT_THROW(upsample_highlight(Image(8, 7, 3), small, full), std::invalid_argument);
  EXPECT_THROW(upsample_highlight(Image(8, 8, 1), small, full), std::invalid_argument);
  EXPECT_THROW(upsample_highlight({}, {}, full), std::invalid_argument);
  EXPECT_THROW(upsample_highlight(small, small, full, ByteImage(8, 8, 1)), std::invalid_argument);
  EXPECT_THROW(upsample_highlight(small, small, full, {}, {.radius_px = 0}), Error);
  EXPECT_THROW(upsample_highlight(small, small, full, {}, {.radius_px = 65}), Error);
  EXPECT_THROW(upsample_highlight(small, small, full, {}, {.epsilon = 0}), Error);
  EXPECT_THROW(upsample_highlight(small, small, full, {}, {.epsilon = kNan}), Error);
}

}  // namespace
}  // namespace faceprobe::highlight::testing

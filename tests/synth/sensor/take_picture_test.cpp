#include "faceprobe/synth/sensor.h"

#include "faceprobe/core/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr SensorSettings kPlain = {
    .blur_px = 0, .vignetting = 0, .read_noise = 0, .shot_noise = 0, .sharpening = 0, .jpeg_quality = 0};

SensorPicture picture_of(const Image& light, const SensorSettings& settings, std::uint64_t seed = 1) {
  Random random({seed});
  return take_picture(light, settings, random);
}

Image ramp(int width, int height, float top) {
  Image light(width, height, 3);
  const auto count = static_cast<float>(light.values().size());
  for (std::size_t i = 0; i < light.values().size(); ++i) light.values()[i] = top * static_cast<float>(i) / count;
  return light;
}

TEST(TakePicture, PlainIsTheSrgbCurve) {
  const Image light = ramp(64, 40, 1.0F);
  const SensorPicture picture = picture_of(light, kPlain);
  for (std::size_t i = 0; i < light.values().size(); ++i) {
    // Half a code for the rounding, and the table's .003.
    EXPECT_NEAR(picture.photo.values()[i], 255.0F * srgb_from_linear(light.values()[i]), 0.504F);
  }
}

TEST(TakePicture, FlagsEachChannelAtOrOverWhite) {
  Image light(4, 1, 3, 0.5F);
  light(1, 0, 0) = 1.0F;
  light(2, 0, 1) = 7.0F;
  light(3, 0, 1) = 1.5F;
  light(3, 0, 2) = std::numeric_limits<float>::infinity();
  const SensorPicture picture = picture_of(light, kPlain);
  EXPECT_EQ(picture.clip(0, 0), 0);
  EXPECT_EQ(picture.clip(1, 0), 1);
  EXPECT_EQ(picture.clip(2, 0), 2);
  EXPECT_EQ(picture.clip(3, 0), 6);
  EXPECT_EQ(picture.photo(2, 0, 1), 255);
  EXPECT_EQ(picture.photo(2, 0, 0), picture.photo(0, 0, 0));
}

TEST(TakePicture, ClippingIsBeforeTheCurve) {
  SensorSettings settings = kPlain;
  settings.curve_shoulder = 1;  // .98 comes out as 254 or so, but is not clipped
  const SensorPicture picture = picture_of(Image(2, 2, 3, 0.98F), settings);
  EXPECT_EQ(picture.clip(0, 0), 0);
}

TEST(TakePicture, NoiseHasTheVarianceThatWasSet) {
  for (const float level : {0.0F, 0.25F, 0.6F}) {
    SensorSettings settings = kPlain;
    settings.read_noise = 0.01F;
    settings.shot_noise = 0.03F;
    // On top of .1, so that the curve's end at 0 cuts nothing off.
    const float light = level + 0.1F;
    const SensorPicture picture = picture_of(Image(200, 200, 3, light), settings);
    double sum = 0, squares = 0;
    for (const std::uint8_t code : picture.photo.values()) {
      const double x = linear_from_srgb(static_cast<float>(code) / 255.0F);
      sum += x;
      squares += x * x;
    }
    const auto n = static_cast<double>(picture.photo.values().size());
    const double variance = squares / n - sum / n * (sum / n);
    const double expected = 0.01 * 0.01 + 0.03 * 0.03 * static_cast<double>(light);
    EXPECT_NEAR(sum / n, light, 4 * std::sqrt(expected / n) + 1e-4);  // the decoded codes' mean is off by their curvature
    // 120,000 draws scatter by .4 %; rounding to codes adds their step^2 / 12: 2 % at .1, where the noise is lowest.
    EXPECT_NEAR(variance / expected, 1.0, 0.03) << level;
  }
}

TEST(TakePicture, BlurKeepsLightAndComesBeforeClipping) {
  Image light(31, 31, 3);
  light(15, 15, 0) = 40.0F;
  SensorSettings settings = kPlain;
  settings.blur_px = 1.0F;
  const SensorPicture picture = picture_of(light, settings);
  double variance = 0, sum = 0;
  int clipped = 0;
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      if (picture.clip(x, y) & 1) ++clipped;
      EXPECT_EQ(picture.photo(x, y, 1), 0);
    }
  }
  EXPECT_GE(clipped, 9);  // a Gaussian of 40 is over 1 within two deviations of its middle
  light(15, 15, 0) = 1.0F;
  const Image seen = decode_srgb(picture_of(light, settings).photo);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      sum += seen(x, y, 0);
      variance += static_cast<double>(seen(x, y, 0)) * ((x - 15) * (x - 15) + (y - 15) * (y - 15));
    }
  }
  // Codes of the outer parts are rounded: half of code 1 is 1.5e-4, over some 20 pixels at up to 4 px from the middle.
  EXPECT_NEAR(sum, 1.0, 0.01);
  EXPECT_NEAR(variance / sum, 2.0, 0.06);  // 1 along each axis
}

TEST(TakePicture, CornersLoseWhatVignettingSays) {
  SensorSettings settings = kPlain;
  settings.vignetting = 0.4F;
  const Image seen = decode_srgb(picture_of(Image(101, 101, 3, 0.5F), settings).photo);
  EXPECT_NEAR(seen(50, 50, 0), 0.5F, 3e-3F);       // half a code there is .002
  EXPECT_NEAR(seen(0, 0, 1), 0.5F * 0.6F, 6e-3F);  // its centre is half a pixel inside the corner
  EXPECT_NEAR(seen(100, 50, 2), 0.5F * 0.8F, 6e-3F);
}

TEST(TakePicture, SharpeningOvershootsAtEdgesOnly) {
  Image light(16, 16, 3, 0.1F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) light(x, y, 1) = 0.4F;
  }
  SensorSettings settings = kPlain;
  const ByteImage plain = picture_of(light, settings).photo;
  settings.sharpening = 1;
  const ByteImage sharp = picture_of(light, settings).photo;
  EXPECT_GT(sharp(8, 5, 1), plain(8, 5, 1) + 10);
  EXPECT_LT(sharp(7, 5, 1), plain(7, 5, 1) - 10);
  EXPECT_EQ(sharp(3, 5, 1), plain(3, 5, 1));
  EXPECT_EQ(sharp(7, 5, 0), plain(7, 5, 0));
}

TEST(TakePicture, GreyPhotosHaveThreeEqualChannels) {
  SensorSettings settings;
  settings.grey = true;
  settings.jpeg_quality = 60;
  Image light = ramp(40, 30, 1.0F);
  for (int y = 0; y < 30; ++y) light(3, y, 0) = 3.0F;
  const SensorPicture picture = picture_of(light, settings);
  for (std::size_t i = 0; i < picture.photo.pixel_count(); ++i) {
    EXPECT_EQ(picture.photo.data()[3 * i], picture.photo.data()[3 * i + 1]);
    EXPECT_EQ(picture.photo.data()[3 * i], picture.photo.data()[3 * i + 2]);
  }
  EXPECT_EQ(picture.clip(3, 5), 1);  // the colour that clipped is still told
}

TEST(TakePicture, SameKeySameBytes) {
  const Image light = ramp(50, 50, 1.2F);
  const SensorSettings settings;
  const SensorPicture a = picture_of(light, settings, 5);
  const SensorPicture b = picture_of(light, settings, 5);
  const SensorPicture c = picture_of(light, settings, 6);
  EXPECT_EQ(a.photo, b.photo);
  EXPECT_EQ(a.clip, b.clip);
  EXPECT_FALSE(a.photo == c.photo);
}

TEST(TakePicture, BadLightIsBlackAndBadSettingsAreRefused) {
  Image light(8, 8, 3, 0.5F);
  light(4, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  light(4, 4, 1) = -3.0F;
  const SensorPicture picture = picture_of(light, kPlain);
  EXPECT_EQ(picture.photo(4, 4, 0), 0);
  EXPECT_EQ(picture.photo(4, 4, 1), 0);
  EXPECT_THROW(picture_of(Image(8, 8, 1), kPlain), std::invalid_argument);
  EXPECT_THROW(picture_of(light, {.jpeg_quality = 101}), std::invalid_argument);
  EXPECT_THROW(picture_of(light, {.blur_px = std::numeric_limits<float>::quiet_NaN()}), std::invalid_argument);
  EXPECT_TRUE(picture_of(Image(0, 0, 3), {}).photo.empty());
}

}  // namespace
}  // namespace faceprobe::synth

#include "train/radiometric.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace faceprobe::train {
namespace {

// Changes of log albedo per unit of pigment, red, green, blue: any two directions would do.
const Eigen::RowVector3d kMelanin(0.45, 0.75, 1.0);
const Eigen::RowVector3d kHaemoglobin(0.12, 1.0, 0.75);

// What a camera of the family writes for light: the inverse of linear_from_code().
double code_from_linear(double linear, double contrast) {
  const double light = std::clamp(linear, 0.0, 1.0);
  const double srgb = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return 1 / (1 + std::pow(1 / std::clamp(srgb, 1e-12, 1.0) - 1, 1 / contrast));
}

struct Camera {
  double contrast = 1;                                    // of the family
  double noise_codes = 0;                                 // standard deviation
  double relief = 0;                                      // fine shading, in log light
  Eigen::RowVector3d light = Eigen::RowVector3d::Ones();  // its colour
  double shading = 0.7;                                   // of the face, in log light, smooth
  double pigment = 0.15;                                  // standard deviation of fine changes
};

Image fine_field(int size, double deviation, std::uint64_t seed) {
  Random random({seed});
  Image field(size, size, 1);
  for (float& value : field.values()) value = static_cast<float>(random.normal());
  // Means of 3 x 3, twice: spots of a few pixels.
  for (int turn = 0; turn < 2; ++turn) {
    const Image before = field;
    for (int y = 1; y < size - 1; ++y) {
      for (int x = 1; x < size - 1; ++x) {
        float sum = 0;
        for (int j = -1; j <= 1; ++j) {
          for (int i = -1; i <= 1; ++i) sum += before(x + i, y + j);
        }
        field(x, y) = sum / 9;
      }
    }
  }
  double squares = 0;
  for (const float value : field.values()) squares += static_cast<double>(value * value);
  const double scale = deviation / std::sqrt(squares / static_cast<double>(field.values().size()));
  for (float& value : field.values()) value *= static_cast<float>(scale);
  return field;
}

// Skin of two pigments under smooth shading, as the camera's bytes.
ByteImage skin(const Camera& camera, std::uint64_t seed = 7) {
  constexpr int kSize = 192;
  const Image melanin = fine_field(kSize, camera.pigment, seed);
  const Image haemoglobin = fine_field(kSize, camera.pigment, seed + 1);
  const Image relief = fine_field(kSize, camera.relief, seed + 2);
  Random random({seed, 3});
  ByteImage bytes(kSize, kSize, 3);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double shading =
          std::exp(camera.shading * std::sin(0.03 * x) * std::cos(0.02 * y) + static_cast<double>(relief(x, y)));
      for (int c = 0; c < 3; ++c) {
        const double pigments =
            static_cast<double>(melanin(x, y)) * kMelanin(c) + static_cast<double>(haemoglobin(x, y)) * kHaemoglobin(c);
        const double level = Eigen::RowVector3d(0.5, 0.31, 0.22)(c) * camera.light(c);
        const double code = 255 * code_from_linear(level * shading * std::exp(-pigments), camera.contrast);
        bytes(x, y, c) =
            static_cast<std::uint8_t>(std::clamp(std::lround(code + camera.noise_codes * random.normal()), 0L, 255L));
      }
    }
  }
  return bytes;
}

ResponseFit fit(const Camera& camera) {
  const ByteImage bytes = skin(camera);
  return fit_response(skin_triples(bytes, ByteImage(bytes.width(), bytes.height(), 1, 1)));
}

TEST(Radiometric, ContrastOneIsSrgbAndTheCurvesAreInverse) {
  for (int i = 0; i < 255; ++i) {
    const double code = i / 255.0;
    EXPECT_NEAR(linear_from_code(code, 1), static_cast<double>(linear_from_srgb(static_cast<float>(code))),
                1e-6);  // float
    for (const double contrast : {0.7, 1.0, 1.4}) {
      // sRGB's two branches meet with a gap of about 1e-8 where the standard rounds its constants.
      EXPECT_NEAR(code_from_linear(linear_from_code(code, contrast), contrast), code, 1e-6);
      EXPECT_GT(linear_from_code(code + 1 / 256.0, contrast), linear_from_code(code, contrast)) << code;
    }
  }
  const ByteImage bytes = skin({});
  const Image linear = linearise(bytes, 1);
  const Image expected = decode_srgb(bytes);
  for (std::size_t i = 0; i < linear.values().size(); ++i) ASSERT_NEAR(linear.data()[i], expected.data()[i], 1e-6F);
}

TEST(Radiometric, TheCamerasCurveIsRecovered) {
  for (const double contrast : {0.75, 1.25}) {
    const ResponseFit found = fit({.contrast = contrast});
    EXPECT_FALSE(found.kept_srgb) << found.reason;
    EXPECT_TRUE(found.reason.empty());
    EXPECT_EQ(found.contrast, found.fitted);
    // Rounding to bytes and the means of 3 x 3 codes pull by about 1 %; sRGB itself is 20 % or more off.
    EXPECT_NEAR(found.contrast / contrast, 1, 0.03);
    EXPECT_LT(found.residual, 0.6 * found.residual_srgb) << "and it matters";
  }
}

TEST(Radiometric, TheColourOfTheLightDoesNotMatter) {
  // A warm light; its blue is noisier, so the tolerance is twice that of the test above.
  const ResponseFit found = fit({.contrast = 1.25, .light = {1.1, 0.9, 0.6}});
  EXPECT_NEAR(found.fitted / 1.25, 1, 0.06);
}

// Codes without the rounding to bytes, at many levels of light; `code` is the camera.
template <class Code>
SkinTriples exact_triples(const Code& code) {
  Random random({11});
  SkinTriples triples{Eigen::MatrixX3d(3000, 3), Eigen::MatrixX3d(3000, 3), Eigen::MatrixX3d(3000, 3)};
  for (Eigen::Index i = 0; i < 3000; ++i) {
    const double light = random.log_between(0.1, 1.5);
    for (Eigen::MatrixX3d* place : {&triples.middle, &triples.before, &triples.after}) {
      const Eigen::RowVector3d logs = -0.05 * random.normal() * kMelanin - 0.05 * random.normal() * kHaemoglobin;
      for (int c = 0; c < 3; ++c) {
        (*place)(i, c) = code(light * Eigen::RowVector3d(0.5, 0.31, 0.22)(c) * std::exp(logs(c)));
      }
    }
  }
  return triples;
}

TEST(Radiometric, ExactCodesGiveTheExactCurve) {
  // Only the search's own step is left: a parabola over steps of 2 %.
  const ResponseFit found = fit_response(exact_triples([](double linear) { return code_from_linear(linear, 0.85); }));
  EXPECT_FALSE(found.kept_srgb) << found.reason;
  EXPECT_NEAR(found.contrast, 0.85, 0.01);
  EXPECT_LT(found.residual, 2e-3);
}

TEST(Radiometric, APlainPowerCannotBeSeen) {
  // Why the family is not one: under sRGB all log differences are 1.3 times too large, and still lie in a plane.
  const ResponseFit found =
      fit_response(exact_triples([](double linear) { return code_from_linear(std::pow(linear, 1.3), 1); }));
  EXPECT_LT(found.residual_srgb, 1e-6);  // nothing is left but double's rounding; in the test above it is 1e-2
  EXPECT_TRUE(found.kept_srgb);
}

TEST(Radiometric, SrgbPhotosStaySrgb) {
  for (const double noise : {0.0, 1.0}) {
    const ResponseFit found = fit({.noise_codes = noise});
    EXPECT_TRUE(found.kept_srgb);
    EXPECT_EQ(found.contrast, 1);
    EXPECT_NE(found.reason.find("sRGB is kept"), std::string::npos);
  }
}

TEST(Radiometric, WeakEvidenceLeavesSrgb) {
  // Noise of three codes, relief as strong as pigment, and skin without pigment: the camera's curve is not sRGB, but
  // nothing shows it.
  for (const Camera& camera :
       {Camera{.contrast = 1.25, .noise_codes = 3}, Camera{.contrast = 1.25, .relief = 0.06, .pigment = 0.05},
        Camera{.contrast = 1.25, .pigment = 0.001}}) {
    const ResponseFit found = fit(camera);
    EXPECT_TRUE(found.kept_srgb);
    EXPECT_EQ(found.contrast, 1);
    EXPECT_FALSE(found.reason.empty());
  }
  // One level of light: each channel is scaled by its own number, which a plane survives.
  EXPECT_TRUE(fit({.contrast = 0.75, .shading = 0}).kept_srgb);
}

TEST(Radiometric, TriplesAreTakenFromUnclippedSkinOnly) {
  const ByteImage bytes = skin({});
  ByteImage mask(bytes.width(), bytes.height(), 1);
  EXPECT_EQ(skin_triples(bytes, mask).middle.rows(), 0);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 192; ++x) mask(x, y) = 1;
  }
  const Eigen::Index half = skin_triples(bytes, mask).middle.rows();
  const Eigen::Index all = skin_triples(bytes, ByteImage(192, 192, 1, 1)).middle.rows();
  EXPECT_GT(half, 1000);
  EXPECT_NEAR(static_cast<double>(half) / static_cast<double>(all), 0.5, 0.1);  // light differs between the halves
  EXPECT_EQ(skin_triples(ByteImage(192, 192, 3, 255), ByteImage(192, 192, 1, 1)).middle.rows(), 0);
  // Grey relief is no pigment: with all channels alike nothing is left.
  ByteImage grey = bytes;
  for (std::size_t i = 0; i < grey.pixel_count(); ++i)
    grey.data()[3 * i + 1] = grey.data()[3 * i + 2] = grey.data()[3 * i];
  EXPECT_EQ(skin_triples(grey, ByteImage(192, 192, 1, 1)).middle.rows(), 0);
}

TEST(Radiometric, RefusesWhatDoesNotFit) {
  const ByteImage bytes = skin({});
  EXPECT_THROW(skin_triples(bytes, ByteImage(4, 4, 1, 1)), std::invalid_argument);
  EXPECT_THROW(skin_triples(bytes, ByteImage(192, 192, 1, 1), {.spacing_px = 0}), std::invalid_argument);
  EXPECT_THROW(linearise(bytes, 0), std::invalid_argument);
  SkinTriples triples{Eigen::MatrixX3d::Constant(500, 3, 0.5), Eigen::MatrixX3d::Constant(500, 3, 0.5),
                      Eigen::MatrixX3d::Constant(500, 3, 0.5)};
  EXPECT_THROW(fit_response(triples, {.max_contrast = 1}), std::invalid_argument);
  EXPECT_TRUE(fit_response(triples).kept_srgb) << "no change at all is no evidence";
  triples.after(3, 1) = 1;
  EXPECT_THROW(fit_response(triples), std::invalid_argument);
  triples.after.resize(10, 3);
  EXPECT_THROW(fit_response(triples), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train

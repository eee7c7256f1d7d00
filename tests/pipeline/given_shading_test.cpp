// Shading by somebody else's split: its level, its size, and the colour that the paper's recolouring takes from it.
#include "pipeline/given_shading.h"

#include "faceprobe/core/color.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/lighting/recolour.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::pipeline {
namespace {

constexpr int kSize = 200;

ShadingSplit one_colour(const Eigen::Vector3f& colour) {
  return [colour](const Image& diffuse) {
    Image shading = diffuse;
    for (std::size_t i = 0; i < shading.values().size(); ++i) shading.data()[i] = colour[static_cast<int>(i % 3)];
    return shading;
  };
}

TEST(GivenShading, IsBroughtToTheAssumedLevelOfSkinAndKeepsItsColour) {
  const Image diffuse(kSize, kSize, 3, 0.14F);
  const ByteImage skin(kSize, kSize, 1, 1), clipped(kSize, kSize, 1);
  for (const float level : {0.01F, 40.0F}) {
    int seen = 0;
    const auto split = [&](const Image& small) {
      seen = small.width();
      return one_colour(level * Eigen::Vector3f(1.2F, 1, 0.8F))(small);
    };
    const Image shading = given_shading(split, diffuse, skin, clipped, 1);
    EXPECT_EQ(seen, 128) << "what it is trained on";
    ASSERT_TRUE(shading.same_size(diffuse));
    const float* middle = shading.pixel(kSize / 2, kSize / 2);
    EXPECT_NEAR(middle[0] / middle[1], 1.2F, 1e-4F);
    EXPECT_NEAR(middle[2] / middle[1], 0.8F, 1e-4F);
    // Enlarged pictures may lack a pixel at their edge: a hundredth of 200.
    EXPECT_NEAR(luminance(diffuse.pixel(0, 0)) / luminance(middle), lighting::kSkinLuminance, 0.01F);
  }
}

TEST(GivenShading, ClippedPixelsAndWhatIsNoSkinSayNothingOfTheLevelAndNothingIsBlack) {
  Image diffuse(64, 64, 3, 0.14F);
  ByteImage skin(64, 64, 1, 1), clipped(64, 64, 1);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (y < 16) clipped(x, y) = 7;
      if (y >= 48) skin(x, y) = 0;
      if (y < 16 || y >= 48) std::fill_n(diffuse.pixel(x, y), 3, 5.0F);
    }
  }
  const auto dark_right = [](const Image& small) {
    Image shading(small.width(), small.height(), 3, 1.0F);
    for (int y = 0; y < small.height(); ++y) std::fill_n(shading.pixel(small.width() - 8, y), 24, 0.0F);
    return shading;
  };
  const Image shading = given_shading(dark_right, diffuse, skin, clipped, 1);
  // 56 columns of 64 are lit, and all of them are as bright in the diffuse layer.
  EXPECT_NEAR(shading(8, 32, 1), 0.14F / lighting::kSkinLuminance * 64 / 56, 1e-4F);
  EXPECT_NEAR(shading(62, 32, 1), 0.01F * 0.14F / lighting::kSkinLuminance, 1e-5F);
}

TEST(GivenShading, AnAnswerOfAnotherSizeIsRefused) {
  const Image diffuse(64, 64, 3, 0.1F);
  const ByteImage skin(64, 64, 1, 1), clipped(64, 64, 1);
  const auto other = [](const Image&) { return Image(64, 32, 3); };
  EXPECT_THROW(given_shading(other, diffuse, skin, clipped, 1), std::invalid_argument);
  const auto grey = [](const Image&) { return Image(64, 64, 1); };
  EXPECT_THROW(given_shading(grey, diffuse, skin, clipped, 1), std::invalid_argument);
}

TEST(GivenShading, OptionsWantWhoGivesIt) {
  EstimateOptions options;
  options.shading = ShadingSource::kGiven;
  EXPECT_NE(options.validate().find("shading_split"), std::string::npos);
  options.shading_split = one_colour({1, 1, 1});
  EXPECT_EQ(options.validate(), "");
}

// Eq. 6 of the paper: every highlight has the colour of the shading, and so has the light that the paper's solver finds, channel by channel.
TEST(GivenShading, IsTheColourOfThePapersHighlightsAndLight) {
  const Eigen::Vector3f colour(0.5F, 1, 1.5F);
  EstimateOptions options;
  options.solve.solver = lighting::Solver::kPaper;
  options.solve.nside = 8;
  options.solve.iterations = 5;
  options.shading = ShadingSource::kGiven;
  options.shading_split = one_colour(colour);
  const FaceEstimate face = Estimator(options).estimate(testing::portrait()).faces[0];
  EXPECT_EQ(face.sources.shading, ShadingSource::kGiven);
  EXPECT_NEAR(face.light_colour.x(), colour.x(), 0.01F);
  EXPECT_NEAR(face.light_colour.z(), colour.z(), 0.01F);
  const Eigen::MatrixX3f highlight = lighting::recolour_highlights(face.observations);
  ASSERT_GT(highlight.sum(), 0);
  for (Eigen::Index i = 0; i < highlight.rows(); ++i) {
    // Patches at the crop's very edge may have pixels that were enlarged from beyond it.
    EXPECT_NEAR(highlight(i, 0), colour.x() * highlight(i, 1), 0.02F * highlight(i, 1) + 1e-5F) << i;
    EXPECT_NEAR(highlight(i, 2), colour.z() * highlight(i, 1), 0.02F * highlight(i, 1) + 1e-5F) << i;
  }
  const Eigen::RowVector3f light = face.light.radiance.colwise().sum();
  ASSERT_GT(light[1], 0);
  EXPECT_NEAR(light[0] / light[1], colour.x(), 0.02F);
  EXPECT_NEAR(light[2] / light[1], colour.z(), 0.02F);
}

}  // namespace
}  // namespace faceprobe::pipeline

#include "faceprobe/core/color.h"
#include "synth/skin/skin_fixture.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

using testing::plain_texture;
using testing::scattered_points;
using testing::texel_points;
using testing::varied_texture;

TEST(SkinAlbedo, TargetOfItsOwnMeanGivesTheTextureBack) {
  const ByteImage picture = varied_texture(64);
  const SkinTexture texture = prepare_texture("varied", picture);
  SkinSettings settings;
  settings.target_tone = texture.mean_skin;
  SkinPoints points = texel_points(64);
  for (const Region region : {Region::kCheeks, Region::kLips}) {
    std::fill(points.region.begin(), points.region.end(), region);
    const Eigen::MatrixX3f albedo = skin_albedo(&texture, settings, points);
    for (int i = 0; i < 64 * 64; ++i) {
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(std::lround(255.0F * srgb_from_linear(albedo(i, c))), picture(i % 64, i / 64, c)) << i;
    }
  }
}

TEST(SkinAlbedo, UniformSkinHasTheTargetTone) {
  const SkinTexture texture = prepare_texture("plain", plain_texture(32, {180, 140, 120}));
  for (const float melanin : {0.01F, 0.1F, 0.4F}) {
    SkinSettings settings;
    settings.target_tone = skin_tone(melanin, 0.03F);
    const Eigen::MatrixX3f albedo = skin_albedo(&texture, settings, texel_points(32));
    // The fast exponential (3e-6) and float logarithms of colours down to .02 (3e-7 each).
    EXPECT_LE((albedo.rowwise() - settings.target_tone.transpose()).cwiseAbs().maxCoeff(), 1e-5F);
  }
}

TEST(SkinAlbedo, PlainSkinIsMottledAboutTheTargetTone) {
  SkinSettings settings;
  settings.target_tone = skin_tone(0.04F, 0.03F);
  const SkinPoints points = scattered_points(20000, 1);
  const Eigen::MatrixX3f albedo = skin_albedo(nullptr, settings, points);
  const Eigen::RowVector3f mean = albedo.colwise().mean();
  // Patches of 9 mm in a box of 0.2 m: about 11,000 independent ones of 5 % each; what is left is the curvature of exp, .1 %.
  EXPECT_TRUE(
      (mean.array() / settings.target_tone.transpose().array()).isApprox(Eigen::Array3f::Ones().transpose(), 0.005F))
      << mean;
  const Eigen::RowVector3f spread = ((albedo.rowwise() - mean).array().square().colwise().mean()).sqrt();
  EXPECT_GT(spread.maxCoeff() / settings.target_tone.maxCoeff(), 0.01F);
  EXPECT_LT(spread.maxCoeff() / settings.target_tone.maxCoeff(), 0.06F);
}

TEST(SkinAlbedo, UvOutsideTheSquareIsPlainSkin) {
  const SkinTexture texture = prepare_texture("varied", varied_texture(64));
  SkinSettings settings;
  settings.target_tone = skin_tone(0.04F, 0.03F);
  SkinPoints points = texel_points(16);
  const Eigen::MatrixX3f plain = skin_albedo(nullptr, settings, points);
  points.uv.col(0).array() += 1.0F;
  EXPECT_EQ(skin_albedo(&texture, settings, points), plain);
}

TEST(SkinAlbedo, GetsDarkerWithMelanin) {
  const SkinTexture texture = prepare_texture("varied", varied_texture(64));
  const SkinPoints points = texel_points(64);
  // Not the rows with the brow and the lip: those give up part of their redness instead.
  constexpr int kFirst = 8 * 64;
  constexpr int kCount = 48 * 64;
  Eigen::MatrixX3f last = Eigen::MatrixX3f::Ones(kCount, 3);
  for (const float melanin : {0.012F, 0.03F, 0.08F, 0.2F, 0.4F}) {
    SkinSettings settings;
    settings.target_tone = skin_tone(melanin, 0.03F);
    const Eigen::MatrixX3f albedo = skin_albedo(&texture, settings, points).middleRows(kFirst, kCount);
    EXPECT_LT((albedo - last).maxCoeff(), 0.0F) << melanin;
    last = albedo;
  }
}

TEST(SkinAlbedo, FeaturesKeepTheirContrastOnEveryTone) {
  const SkinTexture texture = prepare_texture("varied", varied_texture(64));
  SkinPoints points = texel_points(64);
  const Eigen::Index brow = 2 * 64 + 60;
  const Eigen::Index lip = 62 * 64 + 60;
  points.region[static_cast<std::size_t>(lip)] = Region::kLips;
  for (const float melanin : {0.012F, 0.08F, 0.4F}) {
    SkinSettings settings;
    settings.target_tone = skin_tone(melanin, 0.03F);
    settings.variation = 0.5F;
    const Eigen::MatrixX3f albedo = skin_albedo(&texture, settings, points);
    EXPECT_LT(luminance(Eigen::Vector3f(albedo.row(brow)).data()), 0.2F * luminance(settings.target_tone.data()))
        << melanin;
    // Redder than the skin around: less green against red.
    EXPECT_LT(albedo(lip, 1) / albedo(lip, 0), 0.95F * settings.target_tone[1] / settings.target_tone[0]) << melanin;
  }
}

TEST(SkinAlbedo, StaysWithinZeroAndOneForEverySkin) {
  const SkinTexture texture = prepare_texture("varied", varied_texture(64));
  const SkinTexture white = prepare_texture("white", plain_texture(8, {255, 255, 255}));
  SkinPoints points = texel_points(64);
  for (std::size_t i = 0; i < points.region.size(); ++i)
    points.region[i] = static_cast<Region>(1 + i % kSkinRegionCount);
  Random random({1});
  for (int i = 0; i < 40; ++i) {
    const SkinSettings settings = draw_skin(2, random);
    for (const SkinTexture* use : {&texture, &white, static_cast<const SkinTexture*>(nullptr)}) {
      const Eigen::MatrixX3f albedo = skin_albedo(use, settings, points);
      ASSERT_GT(albedo.minCoeff(), 0.0F);
      ASSERT_LT(albedo.maxCoeff(), 1.0F);
    }
  }
}

TEST(SkinAlbedo, EachPointDependsOnItselfAlone) {
  Random random({2});
  SkinSettings settings = draw_skin(1, random);
  settings.freckles = settings.moles = settings.stubble = settings.redness = 1.0F;
  SkinPoints points = scattered_points(3000, 3);
  const Eigen::MatrixX3f forwards = skin_albedo(nullptr, settings, points);
  EXPECT_EQ(skin_albedo(nullptr, settings, points), forwards);
  points.rest_position = points.rest_position.colwise().reverse().eval();
  EXPECT_EQ(skin_albedo(nullptr, settings, points).colwise().reverse().eval(), forwards);
  settings.seed += 1;
  EXPECT_NE(skin_albedo(nullptr, settings, points).colwise().reverse().eval(), forwards);
}

TEST(SkinAlbedo, RefusesArraysThatDoNotFit) {
  SkinSettings settings;
  settings.target_tone = skin_tone(0.04F, 0.03F);
  SkinPoints points = scattered_points(10, 3);
  points.region.pop_back();
  EXPECT_THROW(skin_albedo(nullptr, settings, points), std::invalid_argument);
  settings.target_tone = Eigen::Vector3f(0.5F, 0.0F, 0.5F);
  EXPECT_THROW(skin_albedo(nullptr, settings, scattered_points(10, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::synth

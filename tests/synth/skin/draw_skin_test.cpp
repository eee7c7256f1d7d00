#include "faceprobe/synth/skin.h"
#include "synth/skin/tone.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr int kDraws = 10000;

TEST(DrawSkin, TonesCoverTheHumanRangeEvenly) {
  Random random({1});
  std::array<int, 5> count{};
  for (int i = 0; i < kDraws; ++i) {
    const SkinSettings skin = draw_skin(10, random);
    ASSERT_GT(skin.target_tone.minCoeff(), 0.0F);
    ASSERT_LT(skin.target_tone.maxCoeff(), 0.9F);
    // Fifths of the logarithm of melanin from .013 to .42.
    const float place = std::log(melanin_of(skin.target_tone) / 0.013F) / std::log(0.42F / 0.013F);
    ++count[static_cast<std::size_t>(std::clamp(static_cast<int>(5 * place), 0, 4))];
  }
  // Blood is read as melanin in part, most of all in light skin, which moves some from one fifth to the next.
  for (const int n : count) EXPECT_NEAR(n / static_cast<double>(kDraws), 0.2, 0.05);
}

TEST(DrawSkin, SharesOfVariationsArePlausible) {
  Random random({2});
  int made_up = 0, stubbly = 0, both = 0, freckled_light = 0, light = 0, freckled_dark = 0, dark = 0;
  for (int i = 0; i < kDraws; ++i) {
    const SkinSettings skin = draw_skin(10, random);
    ASSERT_GE(skin.texture, 0);
    ASSERT_LT(skin.texture, 10);
    made_up += skin.lip_tint > 0 ? 1 : 0;
    stubbly += skin.stubble > 0 ? 1 : 0;
    both += skin.lip_tint > 0 && skin.stubble > 0 ? 1 : 0;
    const float melanin = melanin_of(skin.target_tone);
    if (melanin < 0.03F) ++light, freckled_light += skin.freckles > 0 ? 1 : 0;
    if (melanin > 0.2F) ++dark, freckled_dark += skin.freckles > 0 ? 1 : 0;
    for (const float m : skin.roughness) ASSERT_TRUE(m >= 0.16F && m <= 0.5F);
    for (const float rho : skin.specular_albedo) ASSERT_TRUE(rho >= 0.03F && rho <= 0.6F);
  }
  // Four standard deviations of a share of a quarter in 10,000: .017.
  EXPECT_NEAR(made_up / static_cast<double>(kDraws), 0.25, 0.02);
  EXPECT_NEAR(stubbly / static_cast<double>(kDraws), 0.25, 0.02);
  EXPECT_EQ(both, 0);
  EXPECT_GT(freckled_light * dark, 5 * freckled_dark * light);
}

TEST(DrawSkin, SameSeedSameSkin) {
  Random a({3, 1});
  Random b({3, 1});
  Random c({3, 2});
  const SkinSettings one = draw_skin(5, a);
  const SkinSettings same = draw_skin(5, b);
  const SkinSettings other = draw_skin(5, c);
  EXPECT_EQ(one.target_tone, same.target_tone);
  EXPECT_EQ(one.seed, same.seed);
  EXPECT_EQ(one.roughness, same.roughness);
  EXPECT_NE(one.seed, other.seed);
  EXPECT_EQ(draw_skin(0, c).texture, -1);
}

TEST(DrawPaperSkin, HasOneSpecularAlbedoUniformInZeroToOne) {
  Random random({4});
  std::array<int, 20> count{};
  for (int i = 0; i < kDraws; ++i) {
    const SkinSettings skin = draw_paper_skin(3, random);
    for (const float rho : skin.specular_albedo) ASSERT_EQ(rho, skin.specular_albedo[0]);
    ASSERT_TRUE(skin.specular_albedo[0] >= 0.0F && skin.specular_albedo[0] <= 1.0F);
    ++count[static_cast<std::size_t>(std::min(19, static_cast<int>(20 * skin.specular_albedo[0])))];
    ASSERT_EQ(skin.lip_tint + skin.eye_shadow + skin.blush + skin.stubble + skin.freckles + skin.moles + skin.pore_slope,
              0.0F);
  }
  double chi_square = 0;
  for (const int n : count) chi_square += (n - kDraws / 20.0) * (n - kDraws / 20.0) / (kDraws / 20.0);
  EXPECT_LT(chi_square, 43.8);  // 19 degrees of freedom, exceeded once in a thousand
}

}  // namespace
}  // namespace faceprobe::synth

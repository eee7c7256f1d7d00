#include "synth/skin/tone.h"
#include "faceprobe/core/color.h"
#include "faceprobe/synth/skin.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

TEST(SkinTone, IsThatOfMeasuredLightAndDarkSkin) {
  // Spectral means of light and dark skin integrated to linear Rec.709, to two digits. Nothing in the model is fitted to them, and
  // people of one kind differ by more than a tenth.
  EXPECT_TRUE(skin_tone(0.025F, 0.035F).isApprox(Eigen::Vector3f(0.55F, 0.36F, 0.27F), 0.1F));
  EXPECT_TRUE(skin_tone(0.30F, 0.02F).isApprox(Eigen::Vector3f(0.10F, 0.06F, 0.04F), 0.1F));
}

TEST(SkinTone, FallsWithEachPigmentInEveryChannelAndStaysWithinZeroAndOne) {
  for (float blood = 0.002F; blood < 0.08F; blood *= 1.5F) {
    Eigen::Vector3f last = Eigen::Vector3f::Ones();
    for (float melanin = 0.0F; melanin < 0.5F; melanin += 0.01F) {
      const Eigen::Vector3f tone = skin_tone(melanin, blood);
      EXPECT_LT((tone - last).maxCoeff(), 0) << melanin << ' ' << blood;
      EXPECT_GT(tone.minCoeff(), 0);
      EXPECT_LT((skin_tone(melanin, blood * 1.5F) - tone).maxCoeff(), 0) << melanin << ' ' << blood;
      last = tone;
    }
  }
}

TEST(SkinTone, RedIsReflectedMostAndBlueLeast) {
  for (const float melanin : {0.01F, 0.05F, 0.2F, 0.43F}) {
    const Eigen::Vector3f tone = skin_tone(melanin, 0.03F);
    EXPECT_GT(tone[0], tone[1]);
    EXPECT_GT(tone[1], tone[2]);
  }
}

TEST(SkinTone, MelaninIsFoundBackFromTheTone) {
  for (const float melanin : {0.01F, 0.03F, 0.1F, 0.35F}) {
    EXPECT_NEAR(melanin_of(skin_tone(melanin, kTypicalBlood)) / melanin, 1.0F, 1e-3F);  // 20 halvings and float luminance
  }
}

TEST(SkinTone, RednessShowsLessUnderMelanin) {
  EXPECT_GT(redness_response(skin_tone(0.02F, 0.03F)), 3 * redness_response(skin_tone(0.3F, 0.03F)));
}

}  // namespace
}  // namespace faceprobe::synth

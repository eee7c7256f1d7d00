// How well known highlights come back.
#include "highlight/pictures.h"

#include <gtest/gtest.h>

namespace faceprobe::highlight::testing {
namespace {

// By how many times the RMS error is to lie below that of an empty highlight layer. Each is a little below what the
// method reaches, and what keeps it from more is known: tan stops at steps of .01 in chromaticity, which on pale skin
// is much of a lobe; yang stops growing at .03; shen leaves pixels alone whose smallest channel is below the mean.
struct Case {
  Separator separator;
  double three_hues;
  double one_hue;
};

void expect_recovered(const Dichromatic& scene, Separator separator, double factor) {
  const double empty = rms(black_like(scene.picture), scene.highlight);
  const double error = rms(run(scene.picture, separator).highlight, scene.highlight);
  EXPECT_LT(error * factor, empty) << "factor reached: " << empty / error;
}

class Recovery : public ::testing::TestWithParam<Case> {};

TEST_P(Recovery, FindsWhiteLobesOnThreeHues) {
  const Dichromatic scene = dichromatic(kThreeHues, 0.3F);
  expect_recovered(scene, GetParam().separator, GetParam().three_hues);
}

TEST_P(Recovery, FindsThemOnOneHueOfThreeShades) {
  // The same chromaticity at three brightnesses, as on a face: brightness must not pass for highlight.
  const std::array<Colour, 3> shades = {{{0.8F, 0.5F, 0.35F}, {0.64F, 0.4F, 0.28F}, {0.56F, 0.35F, 0.245F}}};
  const Dichromatic scene = dichromatic(shades, 0.25F);
  expect_recovered(scene, GetParam().separator, GetParam().one_hue);
}

INSTANTIATE_TEST_SUITE_P(Separators, Recovery,
                         ::testing::Values(Case{Separator::kTan, 4, 1.3}, Case{Separator::kYang, 4, 4},
                                           Case{Separator::kShen, 5, 9}),
                         [](const auto& info) { return name_of(info.param.separator); });

class EachSeparator : public ::testing::TestWithParam<Separator> {};

TEST_P(EachSeparator, LeavesDiffuseShadingAlone) {
  const Dichromatic scene = dichromatic(kThreeHues, 0);
  // Constant chromaticity per patch: what is found can only be float rounding of values below 1.
  EXPECT_LT(largest(run(scene.picture, GetParam()).highlight), 1e-5);
}

TEST_P(EachSeparator, LeaksLittleBetweenUnlikeColours) {
  const std::array<Colour, 3> colours = {{{0.8F, 0.4F, 0.2F}, {0.3F, 0.6F, 0.5F}, {0.5F, 0.3F, 0.7F}}};
  const Dichromatic scene = dichromatic(colours, 0);
  const Image black = black_like(scene.picture);
  const double leak = rms(run(scene.picture, GetParam()).highlight, black) / rms(scene.picture, black);
  // Tan sees the colour borders and yang three values of lambda, each several range sigma apart: nothing passes. Shen
  // puts pseudo chromaticities less than .3 apart into one cluster, and the paler colours lose part of their white.
  EXPECT_LT(leak, GetParam() == Separator::kShen ? 0.1 : 1e-5);
}

TEST_P(EachSeparator, ScalesWithTheExposure) {
  const Dichromatic scene = dichromatic(kThreeHues, 0.3F);
  Image brighter = scene.picture;
  for (float& value : brighter.values()) value *= 4;  // a power of two: not one rounding differs
  const Layers once = run(scene.picture, GetParam());
  const Layers four = run(brighter, GetParam());
  for (std::size_t i = 0; i < once.highlight.values().size(); ++i) {
    ASSERT_EQ(once.highlight.values()[i] * 4, four.highlight.values()[i]);
  }
}

TEST_P(EachSeparator, TakesOutTheColourOfTheLight) {
  const Dichromatic scene = dichromatic(kThreeHues, 0.3F);
  // Mean 1 and powers of two: dividing and multiplying are exact, so the layers must agree to the bit.
  const Colour light = {2, 0.5F, 0.5F};
  Image lit = scene.picture;
  for (std::size_t i = 0; i < lit.values().size(); ++i) lit.values()[i] *= light[i % 3];
  const Layers white = run(scene.picture, GetParam());
  // Only the ratio of the light's channels counts.
  const Layers coloured = separate(lit, {}, {.separator = GetParam(), .light_colour = {8, 2, 2}});
  EXPECT_GT(largest(white.highlight), 0.1);
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    ASSERT_EQ(white.highlight.values()[i] * light[i % 3], coloured.highlight.values()[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Separators, EachSeparator, ::testing::ValuesIn(kAll),
                         [](const auto& info) { return name_of(info.param); });

}  // namespace
}  // namespace faceprobe::highlight::testing

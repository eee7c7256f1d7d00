// What sets the three methods apart.
#include "highlight/pictures.h"

#include <gtest/gtest.h>

namespace faceprobe::highlight::testing {
namespace {

Colour plus(const Colour& colour, float white) { return {colour[0] + white, colour[1] + white, colour[2] + white}; }

// Red of the highlight in the middle of a stripe.
float found(const Layers& layers, int stripe, int step) {
  return layers.highlight(stripe * step + step / 2, layers.highlight.height() / 2, 0);
}

TEST(Tan, AStepOfWhiteOnOneColourComesBackExactly) {
  const Colour skin = {0.6F, 0.35F, 0.2F};
  const Layers layers = run(stripes(std::array<Colour, 3>{skin, plus(skin, 0.2F), skin}, 4, 4), Separator::kTan);
  EXPECT_NEAR(found(layers, 1, 4), 0.2F, 1e-6F);  // float rounding
  EXPECT_EQ(found(layers, 0, 4), 0);
}

TEST(Tan, DoesNotCrossABorderBetweenColours) {
  // Red and green chromaticity of the specular-free colours both jump by more than .1, saturation falls as in a
  // highlight.
  const std::array<Colour, 2> colours = {{{0.7F, 0.2F, 0.1F}, {0.25F, 0.5F, 0.35F}}};
  EXPECT_EQ(largest(run(stripes(colours, 6, 6), Separator::kTan).highlight), 0.0);
}

TEST(Tan, LeavesDarkPixelsAlone) {
  const Colour dark = {0.05F, 0.03F, 0.01F};
  const std::array<Colour, 2> below = {dark, plus(dark, 0.02F)};  // under 20/255
  EXPECT_EQ(largest(run(stripes(below, 6, 6), Separator::kTan).highlight), 0.0);
  const std::array<Colour, 2> above = {Colour{0.5F, 0.3F, 0.1F}, Colour{0.7F, 0.5F, 0.3F}};  // ten times that
  EXPECT_NEAR(found(run(stripes(above, 6, 6), Separator::kTan), 1, 6), 0.2F, 1e-6F);
}

TEST(Tan, IgnoresStepsOfChromaticityBelowItsNoiseLimit) {
  const Colour skin = {0.6F, 0.35F, 0.2F};  // maximum chromaticity .522; with .02 of white .512, with .03 .508
  EXPECT_EQ(found(run(stripes(std::array<Colour, 2>{skin, plus(skin, 0.02F)}, 6, 6), Separator::kTan), 1, 6), 0);
  EXPECT_NEAR(found(run(stripes(std::array<Colour, 2>{skin, plus(skin, 0.03F)}, 6, 6), Separator::kTan), 1, 6), 0.03F,
              1e-6F);
}

TEST(Yang, HighlightReachesDiffusePixelsOfItsColourAcrossOtherSurfaces) {
  const Colour skin = {0.6F, 0.35F, 0.2F};   // lambda .727
  const Colour cloth = {0.1F, 0.15F, 0.6F};  // lambda .91, between the two
  const std::array<Colour, 10> colours = {skin, skin, skin, skin, skin, skin, skin, skin, cloth, plus(skin, 0.4F)};
  const Layers layers = run(stripes(colours, 2, 24), Separator::kYang);
  // The iteration ends once the filter raises the maximum chromaticity c by less than .03. Where it weighs highlight
  // and skin alike, c may stop .06 short of the skin's .522: .46 instead, and a highlight of total (1 - g0 / g) / 3 =
  // .22 for .4.
  EXPECT_GT(found(layers, 9, 2), 0.22F);
  EXPECT_LT(found(layers, 9, 2), 0.4F + 1e-4F);
  EXPECT_LT(found(layers, 8, 2), 1e-4F);
  // Without the skin nothing tells that the last stripe is too pale.
  EXPECT_LT(largest(run(stripes(std::array<Colour, 2>{cloth, plus(skin, 0.4F)}, 12, 24), Separator::kYang).highlight),
            0.05);
}

TEST(Yang, AClippedGreyCoreCountsAsHighlight) {
  Dichromatic scene = dichromatic(kThreeHues, 1.5F);
  for (float& value : scene.picture.values()) value = std::min(value, 1.0F);
  const int x = 20;
  const int y = 16;  // the top of the first lobe
  ASSERT_EQ(scene.picture(x, y, 2), 1);
  EXPECT_GT(run(scene.picture, Separator::kYang).highlight(x, y, 0), 0.5F);
}

TEST(Shen, TakesTheMedianOfAColourForDiffuse) {
  const Colour skin = {0.6F, 0.35F, 0.3F};
  const Colour shade = {0.3F, 0.175F, 0.15F};  // dark half, so that the lit skin lies above the mean
  // Of three lit stripes two are diffuse: the median is theirs, and the white of the third comes back.
  const std::array<Colour, 6> colours = {shade, shade, shade, skin, skin, plus(skin, 0.2F)};
  const Layers layers = run(stripes(colours, 4, 4), Separator::kShen);
  EXPECT_NEAR(found(layers, 5, 4), 0.2F, 1e-5F);
  EXPECT_NEAR(found(layers, 4, 4), 0.0F, 1e-5F);
}

TEST(Shen, KeepsColoursOfUnlikeSaturationApart) {
  // Pseudo chromaticities .3 apart: each colour has its own ratio, and its own highlight comes back.
  const Colour strong = {0.9F, 0.12F, 0.1F};
  const Colour weak = {0.5F, 0.45F, 0.35F};
  std::vector<Colour> colours = {strong, strong, plus(strong, 0.1F), weak, weak, plus(weak, 0.1F)};
  colours.resize(26, Colour{0, 0, 0});  // black around them keeps the mean of the smallest channel low
  const Layers layers = run(stripes(colours, 4, 4), Separator::kShen);
  const std::array<float, 6> expected = {0, 0, 0.1F, 0, 0, 0.1F};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found(layers, i, 4), expected[static_cast<std::size_t>(i)], 1e-5F) << i;
}

}  // namespace
}  // namespace faceprobe::highlight::testing

// What the header promises for every separator, whatever the picture.
#include "highlight/pictures.h"

#include "faceprobe/core/error.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <limits>
#include <stdexcept>

namespace faceprobe::highlight::testing {
namespace {

class Contract : public ::testing::TestWithParam<Separator> {};
INSTANTIATE_TEST_SUITE_P(Separators, Contract, ::testing::ValuesIn(kAll),
                         [](const auto& info) { return name_of(info.param); });

void expect_split(const Image& picture, const Layers& layers) {
  ASSERT_EQ(layers.highlight.channels(), 3);
  ASSERT_TRUE(layers.highlight.same_size(picture));
  ASSERT_TRUE(layers.diffuse.same_size(picture));
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    const float value = picture.values()[i];
    const float highlight = layers.highlight.values()[i];
    const float diffuse = layers.diffuse.values()[i];
    ASSERT_GE(highlight, 0);
    ASSERT_GE(diffuse, 0);
    // The difference and the sum are each rounded once: one unit in the last place together.
    ASSERT_LE(std::abs(highlight + diffuse - value), value * FLT_EPSILON);
  }
}

TEST_P(Contract, LayersAddUpAndAreNotNegative) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Image picture = noise(61, 47, seed);
    const Layers layers = run(picture, GetParam());
    EXPECT_GT(largest(layers.highlight), 0.0);  // noise has near-grey pixels among coloured ones
    expect_split(picture, layers);
  }
}

TEST_P(Contract, WhiteLightGivesAGreyHighlightCappedByThePicture) {
  const Image picture = noise(61, 47, 7);
  const Layers layers = run(picture, GetParam());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float* highlight = layers.highlight.pixel(x, y);
      const float amount = std::max({highlight[0], highlight[1], highlight[2]});
      for (int c = 0; c < 3; ++c) ASSERT_EQ(highlight[c], std::min(amount, picture(x, y, c)));
    }
  }
}

TEST_P(Contract, GreyPictureHasNoHighlight) {
  Image grey = noise(40, 30, 1);
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) grey(x, y, 1) = grey(x, y, 2) = grey(x, y, 0);
  }
  const Layers layers = run(grey, GetParam());
  EXPECT_EQ(largest(layers.highlight), 0.0);
  EXPECT_EQ(layers.diffuse, grey);
}

TEST_P(Contract, GreyPictureUnderColouredLightHasNoHighlight) {
  const Colour light = {1, 0.7F, 0.3F};  // not exact in binary: the balanced picture is grey only up to rounding
  Image lit = noise(40, 30, 1);
  for (int y = 0; y < lit.height(); ++y) {
    for (int x = 0; x < lit.width(); ++x) {
      const float grey = lit(x, y, 0);
      for (int c = 0; c < 3; ++c) lit(x, y, c) = grey * light[static_cast<std::size_t>(c)];
    }
  }
  EXPECT_EQ(largest(separate(lit, {}, {.separator = GetParam(), .light_colour = light}).highlight), 0.0);
}

TEST_P(Contract, BlackAndWhitePicturesHaveNoHighlight) {
  for (const float fill : {0.0F, 1.0F}) {
    const Image flat(20, 20, 3, fill);
    const Layers layers = run(flat, GetParam());
    EXPECT_EQ(largest(layers.highlight), 0.0);
    EXPECT_EQ(layers.diffuse, flat);
  }
}

TEST_P(Contract, SaturatedColoursAreKept) {
  // Pure primaries hold no white: nothing can be taken from them.
  const std::array<Colour, 4> primaries = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}}};
  const Image picture = stripes(primaries, 8, 16);
  EXPECT_EQ(largest(run(picture, GetParam()).highlight), 0.0);
}

TEST_P(Contract, ClippedLobesGiveFiniteLayers) {
  Dichromatic scene = dichromatic(kThreeHues, 2.0F);
  for (float& value : scene.picture.values()) value = std::min(value, 1.0F);
  expect_split(scene.picture, run(scene.picture, GetParam()));
}

TEST_P(Contract, NothingHappensOutsideTheMask) {
  const Image picture = noise(50, 40, 3);
  ByteImage mask(50, 40, 1);
  for (int y = 10; y < 35; ++y) {
    for (int x = 5; x < 30; ++x) mask(x, y) = 255;
  }
  const Layers layers = run(picture, GetParam(), mask);
  double inside = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 50; ++x) {
      for (int c = 0; c < 3; ++c) {
        if (mask(x, y) != 0) {
          inside += layers.highlight(x, y, c);
          continue;
        }
        ASSERT_EQ(layers.highlight(x, y, c), 0);
        ASSERT_EQ(layers.diffuse(x, y, c), picture(x, y, c));
      }
    }
  }
  EXPECT_GT(inside, 0);
}

TEST_P(Contract, WhatIsOutsideTheMaskHasNoSay) {
  const Dichromatic scene = dichromatic(kThreeHues, 0.3F);
  ByteImage mask(scene.picture.width(), scene.picture.height(), 1);
  for (int y = 3; y < mask.height() - 3; ++y) {
    for (int x = 3; x < mask.width() - 20; ++x) mask(x, y) = 1;
  }
  Image other = noise(mask.width(), mask.height(), 5);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) == 0) continue;
      for (int c = 0; c < 3; ++c) other(x, y, c) = scene.picture(x, y, c);
    }
  }
  const Layers here = run(scene.picture, GetParam(), mask);
  EXPECT_GT(largest(here.highlight), 0.1);
  EXPECT_EQ(here.highlight, run(other, GetParam(), mask).highlight);
}

TEST_P(Contract, AnEmptyMaskedAreaGivesAnEmptyLayer) {
  const Image picture = noise(12, 9, 3);
  const Layers layers = run(picture, GetParam(), ByteImage(12, 9, 1));
  EXPECT_EQ(largest(layers.highlight), 0.0);
  EXPECT_EQ(layers.diffuse, picture);
}

TEST_P(Contract, ThreadsDoNotChangeTheResult) {
  const Image picture = noise(150, 131, 11);
  const Layers one = run(picture, GetParam(), {}, 1);
  for (const int threads : {0, 2, 3, 7}) {
    const Layers many = run(picture, GetParam(), {}, threads);
    EXPECT_EQ(one.highlight, many.highlight) << threads;
    EXPECT_EQ(one.diffuse, many.diffuse) << threads;
  }
}

TEST_P(Contract, TinyAndThinPicturesWork) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3000, 1}, {1, 3000}}) {
    const Image picture = noise(width, height, 2);
    expect_split(picture, run(picture, GetParam()));
  }
  EXPECT_TRUE(run(Image(), GetParam()).highlight.empty());
}

TEST_P(Contract, BrokenValuesCountAsBlackAndDoNotSpread) {
  const Dichromatic scene = dichromatic(kThreeHues, 0.3F);
  Image zeroed = scene.picture;
  Image broken = scene.picture;
  for (int i = 0; i < 10; ++i) {
    for (int c = 0; c < 3; ++c) zeroed(7 * i, 3 * i, c) = 0;
    broken(7 * i, 3 * i, 0) = std::numeric_limits<float>::quiet_NaN();
    broken(7 * i, 3 * i, 1) = -1;
    broken(7 * i, 3 * i, 2) = i % 2 == 0 ? -std::numeric_limits<float>::infinity() : -0.0F;
  }
  EXPECT_EQ(run(broken, GetParam()).highlight, run(zeroed, GetParam()).highlight);
}

TEST(Separate, SizesMustMatch) {
  EXPECT_THROW(separate(Image(4, 4, 3), ByteImage(4, 5, 1), {}), std::invalid_argument);
  EXPECT_THROW(separate(Image(4, 4, 3), ByteImage(4, 4, 3), {}), std::invalid_argument);
  EXPECT_THROW(separate(Image(4, 4, 1), {}, {}), std::invalid_argument);
}

TEST(Separate, LightMustBePositive) {
  for (const float bad : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const SeparateOptions options{.light_colour = {1, bad, 1}};
    EXPECT_NE(options.validate().find("light_colour"), std::string::npos);
    EXPECT_THROW(separate(Image(4, 4, 3), {}, options), Error);
  }
  EXPECT_EQ(SeparateOptions{}.validate(), "");
}

TEST(SeparatorName, GoesBothWays) {
  for (const Separator separator : kAll) EXPECT_EQ(separator_from_name(separator_name(separator)), separator);
}

TEST(SeparatorName, UnknownOneListsTheChoices) {
  try {
    separator_from_name("magic");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    for (const char* part : {"magic", "tan", "yang", "shen"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
    }
  }
}

}  // namespace
}  // namespace faceprobe::highlight::testing

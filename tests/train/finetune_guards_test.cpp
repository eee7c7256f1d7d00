#include "train/finetune_guards.h"

#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace faceprobe::train {
namespace {

constexpr int kPixels = 60;

// Skin with red lips and a dark beard under shading, and a white highlight on some of it, up to twice as bright as the
// skin.
struct Separation {
  Eigen::MatrixX3d diffuse{kPixels, 3};
  Eigen::MatrixX3d highlight{kPixels, 3};
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(kPixels);

  Separation() {
    Random random({5});
    for (int i = 0; i < kPixels; ++i) {
      Eigen::RowVector3d albedo(0.5, 0.31, 0.22);
      if (i % 5 == 0) albedo << 0.45, 0.18, 0.16;
      if (i % 5 == 1) albedo << 0.2, 0.16, 0.14;
      diffuse.row(i) = albedo * random.between(0.4, 1.2);
      highlight.row(i).setConstant(i % 3 == 0 ? random.between(0, 0.6) : 0.0);
      weight(i) = random.between(0.5, 1);
    }
    weight(7) = 0;
  }
  Eigen::MatrixX3d picture() const { return diffuse + highlight; }
};

using Guard = std::function<Penalty(const Eigen::MatrixX3d&)>;  // of the highlight

// Largest difference to central finite differences, relative to the largest entry of the gradient.
double gradient_error(const Guard& guard, const Eigen::MatrixX3d& highlight) {
  constexpr double kStep = 1e-6;
  const Eigen::MatrixX3d gradient = guard(highlight).gradient;
  double worst = 0;
  for (int i = 0; i < kPixels; ++i) {
    for (int c = 0; c < 3; ++c) {
      Eigen::MatrixX3d up = highlight;
      Eigen::MatrixX3d down = highlight;
      up(i, c) += kStep;
      down(i, c) -= kStep;
      worst = std::max(worst, std::abs((guard(up).value - guard(down).value) / (2 * kStep) - gradient(i, c)));
    }
  }
  return worst / gradient.cwiseAbs().maxCoeff();
}

// Differences with a step of 1e-6 err by step^2 over changes at 1e-2 and by rounding 1e-16 / 1e-6, over gradients of
// 1e-2.
constexpr double kGradientTolerance = 1e-6;

TEST(FinetuneGuards, BlackDiffuseBitesWhenEverythingGoesToTheHighlight) {
  const Separation sane;
  const Eigen::MatrixX3d picture = sane.picture();
  const Guard guard = [&](const Eigen::MatrixX3d& h) { return black_diffuse(picture, h, sane.weight); };
  EXPECT_EQ(guard(sane.highlight).value, 0);
  EXPECT_TRUE(guard(sane.highlight).gradient.isZero(0));
  EXPECT_EQ(guard(0.5 * picture).value, 0) << "half the light is not black";
  EXPECT_NEAR(guard(picture).value, 1, 1e-12);  // all of it: every term is 1
  EXPECT_GT(guard(0.97 * picture).value, 0.4);  // a floor of 3 % instead of 0
  EXPECT_GT(guard(1.05 * picture).value, 1) << "a negative diffuse layer is worse";
  EXPECT_GT(guard(picture).gradient.topRows(7).minCoeff(), 0) << "less highlight is always better";
  EXPECT_TRUE(guard(picture).gradient.row(7).isZero(0)) << "outside the mask";
  EXPECT_LT(gradient_error(guard, 0.97 * picture), kGradientTolerance);
  // Black in the photo is not the network's fault.
  EXPECT_EQ(black_diffuse(Eigen::MatrixX3d::Zero(kPixels, 3), Eigen::MatrixX3d::Zero(kPixels, 3), sane.weight).value, 0);
}

TEST(FinetuneGuards, OneColourDiffuseBitesWhenLipsAndBeardTurnIntoSkin) {
  const Separation sane;
  const Eigen::MatrixX3d picture = sane.picture();
  const double reference = chroma_variance(sane.diffuse, sane.weight);
  const Guard guard = [&](const Eigen::MatrixX3d& h) { return one_colour_diffuse(picture, h, sane.weight, reference); };
  EXPECT_EQ(guard(sane.highlight).value, 0);
  EXPECT_EQ(guard(0.8 * sane.highlight).value, 0) << "a highlight that is a little too weak";
  // The largest diffuse layer of skin's colour, or of grey, that the picture allows in every channel.
  for (const Eigen::RowVector3d& colour : {Eigen::RowVector3d(0.5, 0.31, 0.22), Eigen::RowVector3d(1, 1, 1)}) {
    const Eigen::VectorXd level = (picture * colour.cwiseInverse().asDiagonal()).rowwise().minCoeff();
    const Eigen::MatrixX3d one_colour = level * colour;
    EXPECT_NEAR(guard(picture - one_colour).value, 1, 1e-12);
    const Eigen::MatrixX3d nearly = 0.8 * one_colour + 0.2 * sane.diffuse;
    EXPECT_GT(guard(picture - nearly).value, 0.1);
    EXPECT_LT(gradient_error(guard, picture - nearly), kGradientTolerance);
    // Going down the gradient brings the colours back.
    const Eigen::MatrixX3d h = picture - nearly;
    const Penalty here = guard(h);
    const double step = 0.1 * here.value / here.gradient.squaredNorm();
    EXPECT_LT(guard(h - step * here.gradient).value, here.value);
  }
}

TEST(FinetuneGuards, ColouredHighlightBitesWhenItTakesTheSkinsColours) {
  const Separation sane;
  const Eigen::MatrixX3d picture = sane.picture();
  const Guard guard = [&](const Eigen::MatrixX3d& h) { return coloured_highlight(picture, h, sane.weight); };
  EXPECT_EQ(guard(sane.highlight).value, 0);
  // What leaves one colour behind: the lips' red and the beard's lack of it.
  Eigen::MatrixX3d stolen = sane.highlight;
  for (int i = 0; i < kPixels; i += 5)
    stolen.row(i) += 0.8 * (sane.diffuse.row(i) - sane.diffuse.row(i).minCoeff() * Eigen::RowVector3d::Ones());
  EXPECT_GT(guard(stolen).value, 1e-4);
  EXPECT_LT(gradient_error(guard, stolen), kGradientTolerance);
  // Nothing but colour: a pure red highlight. Energy of the picture in the denominator takes less than 1 % off.
  Eigen::MatrixX3d red = Eigen::MatrixX3d::Zero(kPixels, 3);
  red.col(0) = 0.9 * picture.col(0);
  EXPECT_NEAR(guard(red).value, 1, 0.02);
  // Strength does not matter, until it is too faint to have a colour.
  EXPECT_NEAR(guard(0.5 * red).value, guard(red).value, 0.02);
  EXPECT_EQ(guard(1e-3 * red).value, 0);
}

TEST(FinetuneGuards, ColouredHighlightKnowsTheLight) {
  const Separation sane;
  const Eigen::RowVector3d lamp(1.5, 1.0, 0.5);
  const Eigen::MatrixX3d picture = sane.picture() * lamp.asDiagonal();
  const Eigen::MatrixX3d highlight = sane.highlight * lamp.asDiagonal();
  EXPECT_GT(coloured_highlight(picture, highlight, sane.weight).value, 0.01) << "under white light it would be stolen";
  EXPECT_EQ(coloured_highlight(picture, highlight, sane.weight, 3 * lamp).value, 0);
  const Guard guard = [&](const Eigen::MatrixX3d& h) { return coloured_highlight(picture, h, sane.weight, lamp); };
  EXPECT_LT(gradient_error(guard, sane.highlight + 0.1 * picture), kGradientTolerance);
}

TEST(FinetuneGuards, PenaltiesDoNotDependOnResolutionOrExposure) {
  const Separation sane;
  const Eigen::MatrixX3d picture = sane.picture();
  const Eigen::MatrixX3d h = 0.95 * picture;
  const double reference = chroma_variance(sane.diffuse, sane.weight);
  const auto values = [&](double gain, int copies) {
    const Eigen::MatrixX3d p = gain * picture.replicate(copies, 1);
    const Eigen::MatrixX3d high = gain * h.replicate(copies, 1);
    const Eigen::VectorXd w = sane.weight.replicate(copies, 1);
    return Eigen::Vector3d(black_diffuse(p, high, w).value, one_colour_diffuse(p, high, w, 10 * reference).value,
                           coloured_highlight(p, high, w).value);
  };
  const Eigen::Vector3d here = values(1, 1);
  EXPECT_GT(here.minCoeff(), 1e-4) << "each is awake";
  EXPECT_LT((values(1, 4) - here).cwiseAbs().maxCoeff(), 1e-12);  // the order of sums
  EXPECT_LT((values(3, 1) - here).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FinetuneGuards, PenaltiesRefuseWhatDoesNotFit) {
  const Separation sane;
  const Eigen::MatrixX3d picture = sane.picture();
  EXPECT_THROW(black_diffuse(picture, Eigen::MatrixX3d::Zero(3, 3), sane.weight), std::invalid_argument);
  EXPECT_THROW(black_diffuse(picture, picture, Eigen::VectorXd::Zero(kPixels)), std::invalid_argument);
  EXPECT_THROW(black_diffuse(picture, picture, sane.weight, 1), std::invalid_argument);
  EXPECT_THROW(one_colour_diffuse(picture, picture, sane.weight, 0), std::invalid_argument);
  EXPECT_THROW(coloured_highlight(picture, picture, sane.weight, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(coloured_highlight(picture, picture, sane.weight, {1, 1, 1}, 0.7), std::invalid_argument);
}

// A picture of fine noise, blurred by `passes` means over 3 x 3.
Image texture(int passes) {
  constexpr int kSize = 96;
  Random random({3});
  Image picture(kSize, kSize, 3);
  for (float& value : picture.values()) value = static_cast<float>(random.between(0.2, 0.6));
  for (int pass = 0; pass < passes; ++pass) {
    const Image before = picture;
    const auto inside = [](int at) { return std::clamp(at, 0, kSize - 1); };
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        for (int c = 0; c < 3; ++c) {
          float sum = 0;
          for (int k = 0; k < 9; ++k) sum += before(inside(x + k % 3 - 1), inside(y + k / 3 - 1), c);
          picture(x, y, c) = sum / 9;
        }
      }
    }
  }
  return picture;
}

PhotoMasks masks() { return {ByteImage(96, 96, 1, 255), ByteImage(96, 96, 1, 255), {}}; }

TEST(FinetuneGuards, SharpnessTellsFocusFromBlurAndNotExposure) {
  EXPECT_NEAR(measure_photo(texture(0), masks()).sharpness, 1, 0.02);  // white noise: 18,000 pairs
  const double sharp = measure_photo(texture(2), masks()).sharpness;
  const double blurred = measure_photo(texture(40), masks()).sharpness;  // a blur of 5 px
  EXPECT_GT(sharp, PhotoLimits{}.min_sharpness);
  EXPECT_LT(blurred, PhotoLimits{}.min_sharpness);
  Image dark = texture(2);
  for (float& value : dark.values()) value *= 0.1F;
  EXPECT_NEAR(measure_photo(dark, masks()).sharpness, sharp, 1e-4);  // float's rounding
  EXPECT_EQ(measure_photo(Image(96, 96, 3, 0.5F), masks()).sharpness, 0) << "nothing to be sharp";
}

TEST(FinetuneGuards, SharesAreOfTheSkin) {
  PhotoMasks m = masks();
  m.clipped = ByteImage(96, 96, 1);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (x < 48) m.skin(x, y) = 0;
      if (y < 24) m.seen(x, y) = 0;
      if (y < 60) m.clipped(x, y) = 7;
    }
  }
  const PhotoMeasures measures = measure_photo(texture(1), m);
  EXPECT_NEAR(measures.occluded_share, 0.25, 1e-12);
  EXPECT_NEAR(measures.clipped_share, 0.5, 1e-12);
  EXPECT_GT(measures.sharpness, 0) << "from what is left";
  m.skin = ByteImage(96, 96, 1);
  EXPECT_THROW(measure_photo(texture(1), m), std::invalid_argument);
  EXPECT_THROW(measure_photo(Image(4, 4, 3), masks()), std::invalid_argument);
}

TEST(FinetuneGuards, SeveralLightColoursSpreadTheChromaOfShading) {
  // One half lit by a window, the other by a lamp; and one colour with the same changes of brightness.
  Image two(64, 64, 3);
  Image one(64, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float window = static_cast<float>(x) / 63;
      const float lamp = 1 - window;
      const float brightness = 0.5F + 0.4F * window;
      const float colour[3] = {lamp * 1.2F + window * 0.8F, lamp + window, lamp * 0.6F + window * 1.3F};
      for (int c = 0; c < 3; ++c) {
        two(x, y, c) = colour[c];
        one(x, y, c) = brightness * (c == 2 ? 0.7F : 1.0F);
      }
    }
  }
  const ByteImage all(64, 64, 1, 255);
  EXPECT_GT(chroma_spread(two, all), PhotoLimits{}.max_light_colour_spread);
  EXPECT_LT(chroma_spread(one, all), 1e-6);  // float
  // Two chromaticities of equal light, d apart: each is d / 2 from the mean.
  Image pair(2, 1, 3, 1.0F);
  pair(0, 0, 0) = 1.3F;
  pair(0, 0, 1) = 0.7F;
  EXPECT_NEAR(chroma_spread(pair, ByteImage(2, 1, 1, 1)), 0.5 * std::hypot(0.1, 0.1), 1e-7);
  EXPECT_EQ(chroma_spread(Image(2, 1, 3), ByteImage(2, 1, 1, 1)), 0) << "darkness has no colour";
  EXPECT_THROW(chroma_spread(pair, all), std::invalid_argument);
}

TEST(FinetuneGuards, EachCriterionLeavesAPhotoOutAndSaysWhy) {
  const PhotoMeasures good{.sharpness = 0.5,
                           .occluded_share = 0.1,
                           .clipped_share = 0.01,
                           .reprojection_share = 0.02,
                           .light_colour_spread = 0.01};
  EXPECT_EQ(why_unsuitable(good), "");
  const auto reason = [&](double PhotoMeasures::*measure, double value) {
    PhotoMeasures bad = good;
    bad.*measure = value;
    return why_unsuitable(bad);
  };
  EXPECT_NE(reason(&PhotoMeasures::sharpness, 0.26).find("not sharp: 0.26, and 0.3 is needed"), std::string::npos);
  EXPECT_NE(reason(&PhotoMeasures::occluded_share, 0.5).find("turned away"), std::string::npos);
  EXPECT_NE(reason(&PhotoMeasures::clipped_share, 0.2).find("burnt out"), std::string::npos);
  EXPECT_NE(reason(&PhotoMeasures::reprojection_share, 0.08).find("expression"), std::string::npos);
  EXPECT_NE(reason(&PhotoMeasures::light_colour_spread, 0.1).find("several colours"), std::string::npos);
  EXPECT_NE(reason(&PhotoMeasures::clipped_share, std::numeric_limits<double>::quiet_NaN()), "");
}

}  // namespace
}  // namespace faceprobe::train

#include "faceprobe/highlight/skin_subspace.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/sh.h"
#include "highlight/box_sum.h"
#include "highlight/pictures.h"
#include "highlight/skin_light.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cfloat>
#include <limits>
#include <stdexcept>

namespace faceprobe::highlight::testing {
namespace {

constexpr int kSide = 96;

struct Lobe {
  Eigen::Vector3f normal;  // where it is brightest
  Eigen::Vector3f peak;    // linear RGB
};

struct Head {
  Image picture, diffuse, highlight, normals;
  ByteImage mask;
};

Eigen::Vector3f at(const Image& image, int x, int y) { return Eigen::Map<const Eigen::Vector3f>(image.pixel(x, y)); }

struct Tone {
  float melanin = 0;  // everywhere, in log albedo
  float flush = 0;    // haemoglobin of one cheek
};

// An ellipsoid higher than wide, skin with smooth patches of both pigments, light of order 1 (`radiance`: 9 x 3), lobes.
Head head(const Eigen::MatrixX3d& radiance, const std::vector<Lobe>& lobes, const Tone& tone = {}) {
  Head out{Image(kSide, kSide, 3), Image(kSide, kSide, 3), Image(kSide, kSide, 3), Image(kSide, kSide, 3),
           ByteImage(kSide, kSide, 1)};
  const SkinColours skin;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float u = (static_cast<float>(x) + 0.5F - 0.5F * kSide) / (0.40F * kSide);
      const float v = -(static_cast<float>(y) + 0.5F - 0.5F * kSide) / (0.48F * kSide);
      if (u * u + v * v > 0.92F) continue;
      out.mask(x, y) = 1;
      const float w = std::sqrt(1 - u * u - v * v);
      const Eigen::Vector3f normal = Eigen::Vector3f(u / 0.40F, v / 0.48F, w / 0.45F).normalized();
      const float melanin = tone.melanin + 0.06F * std::sin(5 * u + 1) * std::cos(4 * v);
      const float flush = tone.flush * std::exp(-8 * ((u + 0.4F) * (u + 0.4F) + (v + 0.2F) * (v + 0.2F)));
      const float haemoglobin = flush + 0.08F * std::cos(6 * u) * std::sin(5 * v);
      const Eigen::Vector3f albedo = (skin.mean + melanin * skin.melanin + haemoglobin * skin.haemoglobin).array().exp();
      const Eigen::Vector3f shading = (sh::irradiance(radiance, normal.cast<double>()) / EIGEN_PI).cast<float>();
      Eigen::Vector3f highlight = Eigen::Vector3f::Zero();
      for (const Lobe& lobe : lobes) {
        const float cosine = std::clamp(normal.dot(lobe.normal.normalized()), -1.0F, 1.0F);
        const float angle = std::acos(cosine) / 0.16F;
        highlight += std::exp(-0.5F * angle * angle) * lobe.peak;
      }
      for (int c = 0; c < 3; ++c) {
        out.normals(x, y, c) = normal[c];
        out.diffuse(x, y, c) = albedo[c] * shading[c];
        out.highlight(x, y, c) = highlight[c];
        out.picture(x, y, c) = out.diffuse(x, y, c) + highlight[c];
      }
    }
  }
  return out;
}

// Radiance 1 on the average, more from the upper right; times a colour for each of constant, left-right and up-down.
Eigen::MatrixX3d light(const Eigen::RowVector3d& all, const Eigen::RowVector3d& right, const Eigen::RowVector3d& up) {
  Eigen::MatrixX3d radiance = Eigen::MatrixX3d::Zero(9, 3);
  const double one = 2 * std::sqrt(static_cast<double>(EIGEN_PI));
  radiance.row(0) = one * all;
  radiance.row(3) = one * right;
  radiance.row(1) = one * up;
  return radiance;
}

Head white_head(const Tone& tone = {}) {
  const Eigen::RowVector3d white(1, 1, 1);
  return head(light(white, 0.25 * white, 0.2 * white), {{{0.3F, 0.2F, 1}, {0.2F, 0.2F, 0.2F}}}, tone);
}

// What is exact in the scene is trusted; what the scene has none of (sheen everywhere) is not expected.
SkinSubspaceOptions trusting() {
  return {.rounds = 12,
          .melanin_deviation = 0.05F,
          .haemoglobin_deviation = 0.08F,
          .shading_deviation = 0.01F,
          .colour_deviation = 0.01F,
          .highlight_share = 0.002F,
          .highlight_deviation = 4,
          .threads = 2};
}

double rms_inside(const Image& a, const Image& b, const ByteImage& mask) {
  double sum = 0;
  double count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (mask(x, y) == 0) continue;
      sum += (at(a, x, y) - at(b, x, y)).squaredNorm() / 3;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

void expect_sound(const Image& picture, const Layers& layers) {
  ASSERT_TRUE(layers.highlight.same_size(picture));
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    const float value = picture.values()[i];
    ASSERT_GE(layers.highlight.values()[i], 0);
    ASSERT_GE(layers.diffuse.values()[i], 0);
    ASSERT_LE(std::abs(layers.highlight.values()[i] + layers.diffuse.values()[i] - value), value * FLT_EPSILON);
  }
}

double error_against_black(const Image& highlight, const Head& scene) {
  return rms_inside(highlight, scene.highlight, scene.mask) /
         rms_inside(Image(kSide, kSide, 3), scene.highlight, scene.mask);
}

// Where a lobe of this normal is brightest.
Eigen::Vector2i brightest(const Head& scene, const Eigen::Vector3f& normal) {
  Eigen::Vector2i place(0, 0);
  float best = -1;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float cosine = at(scene.normals, x, y).dot(normal.normalized());
      if (scene.mask(x, y) == 0 || cosine <= best) continue;
      best = cosine;
      place = {x, y};
    }
  }
  return place;
}

float angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::acos(std::min(1.0F, a.normalized().dot(b.normalized()))) * 180 / static_cast<float>(EIGEN_PI);
}

// A third: towards the rim a highlight is expected that this scene does not have, the light's fit is not blind to the lobe, and
// patches with little melanin look as if white light fell on them.
TEST(SkinSubspace, GivesBackTheLayersOfAnExactScene) {
  const Head scene = white_head();
  const Layers layers = separate_skin(scene.picture, {}, scene.mask, scene.normals, trusting());
  expect_sound(scene.picture, layers);
  EXPECT_LT(error_against_black(layers.highlight, scene), 0.33);
  EXPECT_LT(rms_inside(layers.diffuse, scene.diffuse, scene.mask),
            0.04 * rms_inside(scene.diffuse, Image(kSide, kSide, 3), scene.mask));
  const Eigen::Vector2i peak = brightest(scene, {0.3F, 0.2F, 1});
  const Eigen::Vector3f found = at(layers.highlight, peak.x(), peak.y());
  EXPECT_NEAR(found.mean(), 0.2, 0.03);
  EXPECT_LT(angle_deg(found, Eigen::Vector3f::Ones()), 2);  // colour that the patches and the light share
}

TEST(SkinSubspace, SkinWithoutHighlightsKeepsItsColour) {
  const Eigen::RowVector3d white(1, 1, 1);
  const Head scene = head(light(white, 0.25 * white, 0.2 * white), {});
  const Layers layers = separate_skin(scene.picture, {}, scene.mask, scene.normals, trusting());
  EXPECT_LT(rms_inside(layers.highlight, scene.highlight, scene.mask),
            0.04 * rms_inside(scene.diffuse, Image(kSide, kSide, 3), scene.mask));
}

// Of what colour the whole face has, the person's skin takes a part, and what skin and light make together stays.
TEST(SkinLight, SharesColourWithThePersonsSkin) {
  for (const float melanin : {-0.8F, 0.8F}) {
    const Head scene = white_head({.melanin = melanin});
    const std::vector<SkinPixel> pixels = skin_pixels(scene.diffuse, {}, scene.mask, scene.normals);
    SkinLight light = first_skin_light(pixels);
    for (int round = 0; round < 3; ++round) fit_skin_light(pixels, round == 0, 1, light);
    const SkinColours skin;
    EXPECT_GT((light.log_skin - skin.mean).dot(skin.melanin) * melanin, 0.05F);
    const SkinPixel& middle = pixels[pixels.size() / 2];
    const Eigen::Vector3f made =
        light.log_skin.array().exp() * (light.shading.transpose() * middle.normal_basis).array();
    const float* truth = scene.diffuse.data() + 3 * middle.index;
    // The pixel's own pigments, at most .06 and .08 in the logarithm, are not in the light.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(made[c], truth[c], 0.14F * truth[c]) << melanin;
  }
}

// A cheek much redder than the deviations allow for a single pixel: its surroundings are as red. No worse than without the flush,
// but for a little.
TEST(SkinSubspace, AFlushIsNoHighlight) {
  const Head scene = white_head({.flush = 0.4F});
  const Layers layers = separate_skin(scene.picture, {}, scene.mask, scene.normals, trusting());
  EXPECT_LT(error_against_black(layers.highlight, scene), 0.28);
}

TEST(SkinSubspace, TwoHighlightsHaveTheColoursOfTheirSides) {
  const Eigen::Vector3f warm(0.26F, 0.2F, 0.14F);
  const Eigen::Vector3f cool(0.14F, 0.2F, 0.26F);
  const Lobe right{{0.45F, 0, 1}, warm};
  const Lobe left{{-0.45F, 0, 1}, cool};
  const Eigen::RowVector3d slope(0.2, 0, -0.2);
  const Head scene = head(light({1, 1, 1}, slope, {0, 0, 0}), {right, left});
  const Layers layers = separate_skin(scene.picture, {}, scene.mask, scene.normals, trusting());
  expect_sound(scene.picture, layers);
  EXPECT_LT(error_against_black(layers.highlight, scene), 0.33);
  // Those who take the light for white do worse than no highlights at all.
  for (const Separator separator : kAll)
    EXPECT_GT(error_against_black(run(scene.picture, separator, scene.mask).highlight, scene), 1) << name_of(separator);
  for (const Lobe& lobe : {right, left}) {
    const Eigen::Vector2i peak = brightest(scene, lobe.normal);
    const Eigen::Vector3f found = at(layers.highlight, peak.x(), peak.y());
    EXPECT_NEAR(found.mean(), 0.2, 0.05);
    // Half of the way from white, at least: light of order 2 knows a lamp's colour mixed with its surroundings'.
    EXPECT_LT(angle_deg(found, lobe.peak), 0.5F * angle_deg(lobe.peak, Eigen::Vector3f::Ones()));
  }
}

// A channel is left out where it is clipped, and what is true of the others stays.
TEST(SkinSubspace, OneClippedChannelCostsLittle) {
  const Head scene = white_head();
  Head clipped = scene;
  constexpr float kWhite = 0.55F;
  ByteImage clip(kSide, kSide, 1);
  int count = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (clipped.picture(x, y, 0) < kWhite) continue;
      clipped.picture(x, y, 0) = kWhite;
      clipped.highlight(x, y, 0) = kWhite - std::min(kWhite, scene.diffuse(x, y, 0));
      clip(x, y) = 1;
      ++count;
    }
  }
  ASSERT_GT(count, 300);
  const auto separate_at = [&](const ByteImage& flags) {
    return separate_skin(clipped.picture, flags, clipped.mask, clipped.normals, trusting());
  };
  const Layers told = separate_at(clip);
  expect_sound(clipped.picture, told);
  const double whole =
      error_against_black(separate_skin(scene.picture, {}, scene.mask, scene.normals, trusting()).highlight, scene);
  const double error = error_against_black(told.highlight, clipped);
  // Two channels tell less than three, so the error may grow, by half; not to be told makes it larger than that.
  EXPECT_LT(error, 1.5 * whole);
  EXPECT_GT(error_against_black(separate_at({}).highlight, clipped), 1.3 * error);
}

TEST(SkinSubspace, ClippedAltogetherGetsTheSkinAround) {
  Head scene = white_head();
  ByteImage clip(kSide, kSide, 1);
  for (int y = 40; y < 46; ++y) {
    for (int x = 50; x < 56; ++x) {
      for (int c = 0; c < 3; ++c) {
        scene.picture(x, y, c) = 1;
        scene.highlight(x, y, c) = 1 - scene.diffuse(x, y, c);
      }
      clip(x, y) = 7;
    }
  }
  const Layers layers = separate_skin(scene.picture, clip, scene.mask, scene.normals, trusting());
  expect_sound(scene.picture, layers);
  // A patch of pigment is as wide as the gap, so that the skin around is off by its contrast: .1 in the logarithm.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(layers.diffuse(53, 43, c), scene.diffuse(53, 43, c), 0.1F * scene.diffuse(53, 43, c));
}

TEST(SkinSubspace, GreyAndOddPicturesGiveSoundLayers) {
  Head scene = white_head();
  const SkinSubspaceOptions two_threads{.threads = 2};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int c = 1; c < 3; ++c) scene.picture(x, y, c) = scene.picture(x, y, 0);
  expect_sound(scene.picture, separate_skin(scene.picture, {}, scene.mask, scene.normals, two_threads));
  const Image no_normals;
  expect_sound(scene.picture, separate_skin(scene.picture, {}, {}, no_normals, two_threads));
  for (const Colour& colour : {Colour{0, 0, 0}, {1, 1, 1}, {1, 0, 0}, {0, 0, 1e-6F}, {1e6F, 1, 1e-6F}}) {
    const std::array<Colour, 1> one = {colour};
    const Image flat = stripes(one, 20, 20);
    expect_sound(flat, separate_skin(flat, {}, {}, no_normals, two_threads));
    expect_sound(flat, separate_skin(flat, ByteImage(20, 20, 1, 7), {}, no_normals, two_threads));
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {3000, 1}}) {
    const Image picture = noise(width, height, 2);
    expect_sound(picture, separate_skin(picture, {}, {}, no_normals, two_threads));
  }
  EXPECT_TRUE(separate_skin(Image(), {}, {}, no_normals).highlight.empty());
}

TEST(SkinSubspace, BrokenValuesCountAsBlackAndBrokenNormalsAsNone) {
  const Head scene = white_head();
  Head broken = scene;
  Head zeroed = scene;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 20; i < 70; i += 7) {
    for (int c = 0; c < 3; ++c) zeroed.picture(i, i, c) = 0;
    broken.picture(i, i, 0) = kNan;
    broken.picture(i, i, 1) = -1;
    broken.picture(i, i, 2) = std::numeric_limits<float>::infinity();
    for (int c = 0; c < 3; ++c) zeroed.normals(i + 3, i, c) = 0;
    broken.normals(i + 3, i, 1) = kNan;
  }
  EXPECT_EQ(separate_skin(broken.picture, {}, scene.mask, broken.normals).highlight,
            separate_skin(zeroed.picture, {}, scene.mask, zeroed.normals).highlight);
}

TEST(SkinSubspace, NothingHappensOutsideTheMaskAndNothingThereHasASay) {
  const Head scene = white_head();
  Image other = noise(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int c = 0; c < 3 && scene.mask(x, y) != 0; ++c) other(x, y, c) = scene.picture(x, y, c);
  const Layers layers = separate_skin(other, {}, scene.mask, scene.normals);
  EXPECT_EQ(layers.highlight, separate_skin(scene.picture, {}, scene.mask, scene.normals).highlight);
  EXPECT_GT(largest(layers.highlight), 0.05);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (scene.mask(x, y) != 0) continue;
      ASSERT_EQ(at(layers.highlight, x, y), Eigen::Vector3f::Zero());
      ASSERT_EQ(at(layers.diffuse, x, y), at(other, x, y));
    }
  }
  EXPECT_EQ(largest(separate_skin(other, {}, ByteImage(kSide, kSide, 1), {}).highlight), 0);
}

TEST(SkinSubspace, ThreadsDoNotChangeTheResult) {
  const Head scene = white_head();
  const Layers one = separate_skin(scene.picture, {}, scene.mask, scene.normals, {.threads = 1});
  for (const int threads : {0, 2, 3, 7}) {
    const Layers many = separate_skin(scene.picture, {}, scene.mask, scene.normals, {.threads = threads});
    EXPECT_EQ(one.highlight, many.highlight) << threads;
    EXPECT_EQ(one.diffuse, many.diffuse) << threads;
  }
}

TEST(SkinSubspace, ABrighterPictureHasBrighterLayers) {
  const Head scene = white_head();
  const Image as_is = separate_skin(scene.picture, {}, scene.mask, scene.normals).highlight;
  for (const float factor : {0.01F, 7.0F}) {
    Image picture = scene.picture;
    for (float& value : picture.values()) value *= factor;
    Image highlight = separate_skin(picture, {}, scene.mask, scene.normals).highlight;
    for (float& value : highlight.values()) value /= factor;
    // Rounding to seven digits, which the least squares make larger where a face shows a harmonic badly.
    EXPECT_LT(rms_inside(highlight, as_is, scene.mask), 1e-3 * largest(as_is)) << factor;
  }
}

TEST(SkinSubspace, SizesMustFit) {
  EXPECT_THROW(separate_skin(Image(4, 4, 1), {}, {}, {}), std::invalid_argument);
  EXPECT_THROW(separate_skin(Image(4, 4, 3), ByteImage(4, 5, 1), {}, {}), std::invalid_argument);
  EXPECT_THROW(separate_skin(Image(4, 4, 3), {}, ByteImage(4, 4, 3), {}), std::invalid_argument);
  EXPECT_THROW(separate_skin(Image(4, 4, 3), {}, {}, Image(4, 4, 1)), std::invalid_argument);
}

TEST(SkinSubspace, OptionsSayWhatIsWrong) {
  EXPECT_EQ(SkinSubspaceOptions{}.validate(), "");
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::pair<const char*, SkinSubspaceOptions> wrong[] = {{"rounds", {.rounds = 0}},
                                                               {"melanin_deviation", {.melanin_deviation = 0}},
                                                               {"haemoglobin_deviation", {.haemoglobin_deviation = -1}},
                                                               {"shading_deviation", {.shading_deviation = kNan}},
                                                               {"colour_deviation", {.colour_deviation = 11}},
                                                               {"highlight_share", {.highlight_share = 0}},
                                                               {"highlight_deviation", {.highlight_deviation = 100}},
                                                               {"neighbourhood", {.neighbourhood = 1.5F}}};
  for (const auto& [name, options] : wrong) {
    EXPECT_EQ(options.validate().find(name), 0U) << name << ": " << options.validate();
    EXPECT_THROW(separate_skin(Image(4, 4, 3), {}, {}, {}, options), Error);
  }
}

TEST(BoxSum, AddsUpSquares) {
  const Image picture = noise(13, 9, 6);
  for (const int radius : {0, 2, 20}) {
    Image sums = picture;
    box_sum(sums, radius, 2);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 13; ++x) {
        double sum = 0;
        for (int v = std::max(0, y - radius); v <= std::min(8, y + radius); ++v)
          for (int u = std::max(0, x - radius); u <= std::min(12, x + radius); ++u) sum += picture(u, v, 1);
        ASSERT_NEAR(sums(x, y, 1), sum, 1e-4);  // two roundings to float of sums up to 117
      }
    }
  }
}

}  // namespace
}  // namespace faceprobe::highlight::testing

// One person in three lights: what single photos take for skin and is light, the others correct.

#include "pipeline/same_person.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/pipeline/observe.h"
#include "faceprobe/pipeline/report.h"
#include "pipeline/light_result.h"
#include "pipeline/posed_face.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {
namespace {

using testing::LitFace;
using testing::posed_face;
using testing::PosedFace;

EstimateOptions quick() {
  EstimateOptions options;
  options.solve.nside = 8;
  options.solve.iterations = 20;
  options.max_patches = 300;
  options.map_width = 32;
  return options;
}

lighting::Light solve_again(const lighting::Observations& observations, bool, const lighting::SolveOptions& solve) {
  return lighting::solve(observations, solve);
}

// What an estimate of a photo would hold that took `albedo` for the skin's; true skin is kSkin everywhere.
const Eigen::Vector3f kSkin(0.55F, 0.33F, 0.24F);

FaceEstimate estimate_of(const PosedFace& posed, const LitFace& lit, const Eigen::Vector3f& albedo) {
  const EstimateOptions options = quick();
  FaceEstimate face;
  face.face = posed.face;
  face.geometry = posed.geometry;
  const int width = lit.shading.width();
  const int height = lit.shading.height();
  face.clipped = ByteImage(width, height, 1);
  face.layers.highlight = lit.highlight;
  face.layers.diffuse = Image(width, height, 3);
  face.albedo = Image(width, height, 3);
  face.shading = Image(width, height, 3);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < lit.shading.values().size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i % 3);
    face.layers.diffuse.data()[i] = kSkin[c] * lit.shading.data()[i];
    face.albedo.data()[i] = albedo[c];
    face.shading.data()[i] = face.layers.diffuse.data()[i] / albedo[c];
    sum[c] += face.shading.data()[i];
  }
  face.light_colour = sum / sum[1];
  face.observations =
      observe(face.geometry, face.layers.highlight, face.shading, face.clipped, options.max_patches, options.threads);
  static_cast<LightResult&>(face) =
      solved_light(lighting::solve(face.observations, options.solve), face.observations, options);
  return face;
}

Eigen::Vector3f tinted(double red, double blue) {
  return kSkin.cwiseProduct(Eigen::Vector3d(std::exp(red), 1, std::exp(blue)).cast<float>());
}

Eigen::Vector3d colour_of(const FaceEstimate& face) {
  return face.light.radiance.cast<double>().colwise().sum().transpose();
}

// A lamp in a little even light, of another colour and from another side each.
const std::vector<LitFace>& lit_faces(const PosedFace& posed) {
  static const std::vector<LitFace> faces = {light_up(posed, {{direction_from_angles(30, 20), {1.4F, 1, 0.6F}}}, 0.03F),
                                             light_up(posed, {{direction_from_angles(-40, 30), {0.8F, 1, 1.3F}}}, 0.03F),
                                             light_up(posed, {{direction_from_angles(5, 45), {1, 1, 1}}}, 0.03F)};
  return faces;
}

const PosedFace& person() {
  static const PosedFace posed = posed_face(0);
  return posed;
}

TEST(SamePerson, LightsAreNearerInColourThanAlone) {
  const std::vector<LitFace>& lit = lit_faces(person());
  const std::vector<Eigen::Vector3f> taken = {tinted(0.16, -0.1), tinted(-0.12, 0.14), tinted(-0.05, -0.02)};
  std::vector<FaceEstimate> photos;
  std::vector<Eigen::Vector3d> truths;
  for (std::size_t i = 0; i < 3; ++i) {
    photos.push_back(estimate_of(person(), lit[i], taken[i]));
    truths.push_back(colour_of(estimate_of(person(), lit[i], kSkin)));  // the solver's own errors are another matter
  }
  std::vector<double> alone;
  for (std::size_t i = 0; i < 3; ++i) alone.push_back(angle_between_deg(colour_of(photos[i]), truths[i]));
  share_person({&photos[0], &photos[1], &photos[2]}, quick(), solve_again);
  double before = 0;
  double after = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    before += alone[i];
    after += angle_between_deg(colour_of(photos[i]), truths[i]);
    ASSERT_TRUE(photos[i].same_person) << i;
    EXPECT_EQ(photos[i].same_person->photos, 3U);
    EXPECT_TRUE(photos[i].same_person->albedo.isApprox(photos[0].same_person->albedo));
    // Errors of -.003 and .007 are what the three leave.
    EXPECT_TRUE(
        photos[i].same_person->shading_gain.isApprox(taken[i].cwiseQuotient(photos[0].same_person->albedo), 1e-3F));
    EXPECT_EQ(photos[i].light.highlight_gain, photos[0].light.highlight_gain) << "one skin, one gloss";
    EXPECT_FALSE(photos[i].lights.empty());
  }
  EXPECT_GT(before, 6) << "0.1 in log chromaticity is about three degrees each";
  EXPECT_LT(after, 0.35 * before);
  // What the photo showed is not touched.
  const FaceEstimate& first = photos[0];
  for (std::size_t i = 0; i < first.shading.values().size(); i += 97) {
    const float product = first.albedo.data()[i] * first.shading.data()[i];
    if (!(first.shading.data()[i] > 0)) continue;
    EXPECT_NEAR(product, first.layers.diffuse.data()[i], 1e-5F);
  }
  EXPECT_NEAR(first.light_colour[1], 1, 1e-6F);
}

TEST(SamePerson, TheSamePhotoTwiceAndOnePhotoKeepTheirLight) {
  const FaceEstimate own = estimate_of(person(), lit_faces(person())[0], tinted(0.1, -0.1));
  FaceEstimate one = own;
  share_person({&one}, quick(), solve_again);
  EXPECT_EQ(one.light.radiance, own.light.radiance);
  EXPECT_FALSE(one.same_person);
  FaceEstimate two = own;
  share_person({&one, &two}, quick(), solve_again);
  EXPECT_EQ(one.light.radiance, own.light.radiance);
  EXPECT_EQ(two.light.radiance, own.light.radiance);
  ASSERT_TRUE(two.same_person);
  EXPECT_EQ(two.same_person->trust, 1);
}

TEST(SamePerson, APhotoWithoutLitSkinStaysOut) {
  FaceEstimate one = estimate_of(person(), lit_faces(person())[0], tinted(0.1, -0.1));
  FaceEstimate other = estimate_of(person(), lit_faces(person())[1], tinted(-0.1, 0.1));
  FaceEstimate dark = one;
  for (Image* layer : {&dark.layers.diffuse, &dark.shading})
    std::fill(layer->values().begin(), layer->values().end(), 0.0F);
  const Eigen::MatrixX3f before = dark.light.radiance;
  share_person({&one, &dark, &other}, quick(), solve_again);
  EXPECT_FALSE(dark.same_person);
  EXPECT_EQ(dark.light.radiance, before);
  EXPECT_EQ(one.same_person.value().photos, 2U);
  EXPECT_EQ(other.same_person.value().photos, 2U);
}

// Where the albedo came of a prior, the light's colour says how uncertain it is: less so with more photos.
TEST(SamePerson, SeveralPhotosStateLessUncertainty) {
  std::vector<FaceEstimate> photos;
  for (std::size_t i = 0; i < 2; ++i) {
    photos.push_back(estimate_of(person(), lit_faces(person())[i], tinted(0.02, 0)));
    photos.back().light_colour_uncertainty_deg = lighting::colour_uncertainty_deg(photos.back().light_colour, 0.1);
  }
  const double alone = *photos[0].light_colour_uncertainty_deg;
  share_person({&photos[0], &photos[1]}, quick(), solve_again);
  EXPECT_LT(photos[0].light_colour_uncertainty_deg.value(), 0.9 * alone);
}

TEST(SamePerson, AGreyPhotoStaysGrey) {
  LitFace grey = light_up(person(), {{direction_from_angles(30, 20), {1, 1, 1}}}, 0.03F);
  FaceEstimate one = estimate_of(person(), grey, kSkin);
  for (Image* layer : {&one.layers.diffuse, &one.layers.highlight}) {
    for (std::size_t i = 0; i < layer->values().size(); i += 3) std::fill_n(layer->data() + i, 3, layer->data()[i + 1]);
  }
  one.shading = one.layers.diffuse;
  for (float& value : one.shading.values()) value /= 0.5F;
  std::ranges::fill(one.albedo.values(), 0.5F);
  one.observations = observe(one.geometry, one.layers.highlight, one.shading, one.clipped, 300, 0);
  one.observations.grey = true;
  one.light_colour.setOnes();
  FaceEstimate other = estimate_of(person(), lit_faces(person())[0], tinted(0.1, -0.1));
  share_person({&one, &other}, quick(), solve_again);
  EXPECT_TRUE(one.observations.grey);
  EXPECT_LT((one.light.radiance.col(0) - one.light.radiance.col(2)).cwiseAbs().maxCoeff(), 1e-6F);
}

TEST(SamePerson, TheReportSaysWhatChanged) {
  FaceEstimate one = estimate_of(person(), lit_faces(person())[0], tinted(0.1, -0.1));
  Estimate estimate;
  estimate.faces.push_back(one);
  const auto told = [&] {
    return nlohmann::json::parse(report_json(estimate, io::Photo(), quick(), "a.jpg")).at("faces")[0].at("same_person");
  };
  EXPECT_TRUE(told().is_null());
  estimate.faces[0].same_person = SamePerson{3, {1.1F, 1, 0.9F}, kSkin, 0.5};
  EXPECT_EQ(told().at("photos"), 3);
  EXPECT_NEAR(told().at("shading_gain_rgb")[0].get<double>(), 1.1, 1e-6);
  EXPECT_NEAR(told().at("albedo_rgb")[2].get<double>(), 0.24, 1e-6);
  EXPECT_EQ(told().at("trust"), 0.5);
}

}  // namespace
}  // namespace faceprobe::pipeline

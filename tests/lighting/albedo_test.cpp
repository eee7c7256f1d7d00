#include "faceprobe/lighting/albedo.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

struct Face {
  Image diffuse{60, 60, 3};
  ByteImage region{60, 60, 1};
  ByteImage clipped{60, 60, 1};
};

Face face_of_colour(const Eigen::Vector3f& colour) {
  Face face;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      face.region(x, y) = static_cast<std::uint8_t>(1 + (x / 6) % kSkinRegionCount);
      for (int c = 0; c < 3; ++c) face.diffuse(x, y, c) = colour[c] * (0.5F + 0.01F * static_cast<float>(y));
    }
  }
  return face;
}

TEST(Albedo, SkinOnTheLocusIsSeenInWhiteLight) {
  const Face face = face_of_colour({2.2F, 1.0F, 0.6F});
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped);
  EXPECT_NEAR(model.light_colour[0], 1.0F, 1e-3F);
  EXPECT_NEAR(model.light_colour[2], 1.0F, 1e-3F);
}

TEST(Albedo, ProductOfLightAndSkinIsTheDiffuseColour) {
  const Eigen::Vector3f seen(1.2F, 1.0F, 1.1F);  // bluish: partly light, partly skin
  const Face face = face_of_colour(seen);
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped);
  EXPECT_LT(model.light_colour[0], 1.0F);
  EXPECT_GT(model.light_colour[2], 1.0F);
  const Eigen::Vector3f product = model.light_colour.cwiseProduct(model.region_albedo[0]);
  EXPECT_NEAR(product[0] / product[1], 1.2F, 1e-3F);
  EXPECT_NEAR(product[2] / product[1], 1.1F, 1e-3F);
}

TEST(Albedo, ShadingKeepsTheGradientThatRegionsCannotExplain) {
  const Face face = face_of_colour({1.0F, 0.5F, 0.3F});
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped);
  const Image albedo = albedo_picture(model, face.region);
  const float top = face.diffuse(3, 5, 1) / albedo(3, 5, 1);
  const float bottom = face.diffuse(3, 55, 1) / albedo(3, 55, 1);
  EXPECT_NEAR(bottom / top, 1.05F / 0.55F, 0.02F);
}

TEST(Albedo, GreyPhotoHasGreyLight) {
  const Face face = face_of_colour({1, 1, 1});
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped, {}, true);
  EXPECT_TRUE(model.light_colour.isOnes(1e-6F));
  EXPECT_NEAR(model.region_albedo[0][0], model.region_albedo[0][2], 1e-5F);
}

// People and white balances as the two priors have them (albedo.cpp): the stated standard deviation is that of the errors made.
TEST(Albedo, TheColourOfTheLightIsAsUncertainAsItSays) {
  std::mt19937 random(7);
  std::normal_distribution<double> skin(0, 0.20);
  std::normal_distribution<double> balance(0, 0.12);
  constexpr int kPeople = 400;
  double made = 0;
  double stated = 0;
  for (int i = 0; i < kPeople; ++i) {
    const Eigen::Vector3d light(std::exp(balance(random)), 1, std::exp(balance(random)));
    const Eigen::Vector3d albedo(2.2 * std::exp(skin(random)), 1, 0.6 * std::exp(skin(random)));
    const Face face = face_of_colour((0.3 * light.cwiseProduct(albedo)).cast<float>());
    const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped);
    ASSERT_TRUE(model.light_colour_uncertainty_deg);
    const double angle = angle_between_deg(model.light_colour.cast<double>(), light);
    made += angle * angle;
    stated += *model.light_colour_uncertainty_deg * *model.light_colour_uncertainty_deg;
  }
  // Of 800 squares the mean is good to 5 %; the first order of the angle is off by less. Twice that of the root, and a little more.
  EXPECT_NEAR(std::sqrt(made / stated), 1.0, 0.08);
}

TEST(Albedo, WithoutSkinTheColourIsAsUncertainAsWhiteBalances) {
  Face face = face_of_colour({2.2F, 1.0F, 0.6F});
  const double seen = fit_albedo(face.diffuse, face.region, face.clipped).light_colour_uncertainty_deg.value();
  for (auto& value : face.clipped.values()) value = 1;
  const double unseen = fit_albedo(face.diffuse, face.region, face.clipped).light_colour_uncertainty_deg.value();
  // White light both times: the posterior's variance has the share .2^2 / (.2^2 + .12^2) of the prior's.
  EXPECT_NEAR(seen / unseen, std::sqrt(0.04 / (0.04 + 0.0144)), 1e-3);
  EXPECT_NEAR(unseen, degrees(0.12 * std::sqrt(4.0 / 9)), 1e-6);
  EXPECT_FALSE(fit_albedo(face.diffuse, face.region, face.clipped, {}, true).light_colour_uncertainty_deg);
}

// A ball: forehead above, cheeks about the middle, chin and jaw below, under a lamp and an even surround.
struct Ball : Face {
  Image normal{60, 60, 3};

  Ball(const Eigen::Vector3f& towards, float chin) {
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        const float right = (static_cast<float>(x) - 29.5F) / 32;
        const float up = (29.5F - static_cast<float>(y)) / 32;
        const float square = 1 - right * right - up * up;
        if (square < 0.1F) continue;
        const Eigen::Vector3f n(right, up, std::sqrt(square));
        Eigen::Map<Eigen::Vector3f>(normal.pixel(x, y)) = n;
        const Region part = up > 0.4F                ? Region::kForehead
                            : up > -0.2F             ? Region::kCheeks
                            : std::abs(right) < 0.3F ? Region::kChin
                                                     : Region::kJaw;
        region(x, y) = static_cast<std::uint8_t>(part);
        const float albedo = part == Region::kChin || part == Region::kJaw ? chin : 1.0F;
        for (int c = 0; c < 3; ++c)
          diffuse(x, y, c) = 0.4F * albedo * (0.1F + std::max(0.0F, n.dot(towards.normalized())));
      }
    }
  }

  // Shading low on the chin over that as high on the forehead, which a lamp in front makes alike.
  float below_over_above(const Image& normals) const {
    const Image albedo = albedo_picture(fit_albedo(diffuse, region, clipped, normals), region);
    return (diffuse(30, 48, 1) / albedo(30, 48, 1)) / (diffuse(30, 11, 1) / albedo(30, 11, 1));
  }
};

TEST(Albedo, ABeardsShadowIsNotLightFromAbove) {
  const Ball bearded({0, 0, 1}, 0.7F);
  // Without normals the usual ratio is all there is: .95 of the forehead's 1.01 instead of .7.
  const float usual = bearded.below_over_above({});
  EXPECT_LT(usual, 0.8F);
  // With them a third of what was missing is found at least. Not all: such a chin is two standard deviations from the usual, and light a little
  // from above explains a part of it as well.
  const float fitted = bearded.below_over_above(bearded.normal);
  EXPECT_GT(fitted, usual + (1 - usual) / 3);
  EXPECT_LT(fitted, 1.02F);
}

TEST(Albedo, LightFromAboveIsNotABeardsShadow) {
  for (const float up : {0.5F, 1.0F}) {
    const Ball shaved({0.3F, up, 1}, 1);
    const float truth = shaved.diffuse(30, 48, 1) / shaved.diffuse(30, 11, 1);
    EXPECT_LT(truth, 0.6F);
    // A smooth light explains it all; what is left is the prior's pull towards a chin a little darker than a forehead.
    EXPECT_NEAR(shaved.below_over_above(shaved.normal) / truth, 1.0F, 0.08F);
  }
}

TEST(Albedo, RefusesNormalsOfAnotherSize) {
  const Face face = face_of_colour({1, 1, 1});
  EXPECT_THROW(fit_albedo(face.diffuse, face.region, face.clipped, Image(30, 60, 3)), std::invalid_argument);
}

TEST(Albedo, NothingUsableGivesThePriorNotNan) {
  Face face = face_of_colour({0, 0, 0});
  EXPECT_TRUE(fit_albedo(face.diffuse, face.region, face.clipped).region_albedo[0].allFinite());
  for (auto& value : face.clipped.values()) value = 1;
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped);
  EXPECT_GT(model.region_albedo[0].minCoeff(), 0.0F);
  EXPECT_FLOAT_EQ(model.light_colour[0], 1.0F);
}

}  // namespace
}  // namespace faceprobe::lighting

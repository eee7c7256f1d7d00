#include "faceprobe/lighting/albedo.h"

#include <gtest/gtest.h>

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
  const AlbedoModel model = fit_albedo(face.diffuse, face.region, face.clipped, true);
  EXPECT_TRUE(model.light_colour.isOnes(1e-6F));
  EXPECT_NEAR(model.region_albedo[0][0], model.region_albedo[0][2], 1e-5F);
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

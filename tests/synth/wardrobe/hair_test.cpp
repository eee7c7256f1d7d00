#include "faceprobe/synth/wardrobe.h"

#include "synth/wardrobe/egg_head.h"
#include "synth/wardrobe/scalp.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

const Strands* hair_of(const Figure& figure) {
  const Strands* most = nullptr;
  for (const Strands& s : figure.strands) {
    if (s.region == Region::kHair && (most == nullptr || s.tone.size() > most->tone.size())) most = &s;
  }
  return most;
}

class Cuts : public testing::TestWithParam<HairCut> {};

TEST_P(Cuts, GrowOnTheScalpAndStayOutOfTheSkull) {
  const Head head = egg_head();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    WardrobeSettings settings;
    settings.cut = GetParam();
    settings.strands = 2500;
    settings.seed = seed;
    const Figure figure = dress(head, settings);
    const Strands* hair = hair_of(figure);
    ASSERT_NE(hair, nullptr);
    EXPECT_GT(hair->tone.size(), 1500U);
    int inside = 0;
    for (std::size_t s = 0; s < hair->tone.size(); ++s) {
      const Eigen::Vector3f root = hair->points.row(hair->first_point[s]).head<3>().transpose();
      // Roots start 0.4 mm below the skin; the mesh's flat pieces lie another 0.2 mm below the egg: together 0.8 % of 0.078 m.
      EXPECT_NEAR(egg_level(root), 1.0F, 0.01F);
      // Eyes, nose and mouth are bare.
      EXPECT_FALSE(root.z() > -0.02F && root.y() < 0.024F) << root.transpose();
      for (int i = hair->first_point[s] + 1; i < hair->first_point[s + 1]; ++i) {
        const Eigen::Vector3f p = hair->points.row(i).head<3>().transpose();
        inside += egg_level(p) < 0.985F ? 1 : 0;  // 1.2 mm: what a grid of 6.5 mm may be wrong by on this curvature
      }
    }
    EXPECT_EQ(inside, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Cuts,
                         testing::Values(HairCut::kBuzz, HairCut::kShort, HairCut::kParted, HairCut::kFringe,
                                         HairCut::kLong, HairCut::kCurly, HairCut::kTied));

float mean_length(HairCut cut) {
  WardrobeSettings settings;
  settings.cut = cut;
  settings.strands = 600;
  const Figure figure = dress(egg_head(), settings);
  const Strands* hair = hair_of(figure);
  float sum = 0;
  for (std::size_t s = 0; s < hair->tone.size(); ++s) {
    for (int i = hair->first_point[s] + 1; i < hair->first_point[s + 1]; ++i) {
      sum += (hair->points.row(i) - hair->points.row(i - 1)).head<3>().norm();
    }
  }
  return sum / static_cast<float>(hair->tone.size());
}

TEST(Hair, LengthsGoByTheCut) {
  EXPECT_LT(mean_length(HairCut::kBuzz), 0.011F);
  EXPECT_GT(mean_length(HairCut::kShort), mean_length(HairCut::kBuzz));
  EXPECT_LT(mean_length(HairCut::kShort), 0.06F);
  EXPECT_GT(mean_length(HairCut::kLong), 0.12F);
}

TEST(Hair, CapLiesUnderTheStrandsAndHasTheirColour) {
  WardrobeSettings settings;
  settings.hair_colour = {0.3F, 0.2F, 0.1F};
  const Figure figure = dress(egg_head(), settings);
  const SurfaceMesh* cap = nullptr;
  for (const SurfaceMesh& m : figure.meshes) {
    if (m.vertex_region[0] == Region::kHair) cap = &m;
  }
  ASSERT_NE(cap, nullptr);
  EXPECT_EQ(cap->material, Material::kCloth);
  for (const auto& v : cap->vertices.rowwise()) {
    const float level = egg_level(v.transpose());
    ASSERT_GT(level, 0.995F);  // on the egg's flat pieces plus 0.7 mm
    ASSERT_LT(level, 1.015F);
  }
  EXPECT_LT(cap->reflectance.albedo.maxCoeff(), 0.3F);
  EXPECT_GT(cap->reflectance.albedo.x(), cap->reflectance.albedo.z());
}

TEST(Hair, BaldHeadsHaveLashesOnly) {
  WardrobeSettings settings;
  settings.cut = HairCut::kBald;
  for (const Strands& s : dress(egg_head(), settings).strands) EXPECT_EQ(s.region, Region::kEyelids);
}

TEST(Hair, AHatLeavesNoStrandAboveIt) {
  WardrobeSettings settings;
  settings.cut = HairCut::kCurly;
  settings.strands = 2000;
  settings.headwear = Headwear::kBeanie;
  const Figure figure = dress(egg_head(), settings);
  float top = -1;
  for (const Strands& s : figure.strands) {
    if (s.region == Region::kHair) top = std::max(top, s.points.col(1).maxCoeff());
  }
  float hat = -1;
  for (const SurfaceMesh& m : figure.meshes) {
    if (m.vertex_region[0] == Region::kClothes) hat = std::max(hat, m.vertices.col(1).maxCoeff());
  }
  EXPECT_LT(top, hat);
  EXPECT_GT(hat, kEggRadii.y());
}

TEST(Hair, BeardsGrowBelowTheNoseAndNotOnTheLips) {
  const Head head = egg_head();
  WardrobeSettings settings;
  settings.cut = HairCut::kBald;
  settings.beard = 1.0F;
  settings.moustache = 1.0F;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    settings.seed = seed;
    const Figure figure = dress(head, settings);
    const Strands* beard = hair_of(figure);
    ASSERT_NE(beard, nullptr);
    EXPECT_GT(beard->tone.size(), 500U);
    for (std::size_t s = 0; s < beard->tone.size(); ++s) {
      const Eigen::Vector3f root = beard->points.row(beard->first_point[s]).head<3>().transpose();
      if (std::abs(root.x()) < 0.045F) {  // beyond, it climbs to the ears
        EXPECT_LT(root.y(), -0.03F);
      }
      // The mouth's line from corner to corner stays bare.
      const bool lips = std::abs(root.x()) < 0.02F && std::abs(root.y() + 0.068F) < 0.003F && root.z() > -0.03F;
      EXPECT_FALSE(lips);
    }
  }
}

TEST(Scalp, LinePassesOverForeheadTemplesAndNape) {
  const Head head = egg_head();
  const Anatomy anatomy = measure(head);
  const Scalp scalp(anatomy, {}, 1);
  EXPECT_GT(scalp.inside({0, 0.114F, -0.085F}), 0.02F);  // crown
  EXPECT_GT(scalp.inside({0, 0.02F, -0.184F}), 0.02F);   // occiput
  EXPECT_LT(scalp.inside({0, 0.04F, 0.009F}), -0.02F);   // forehead
  EXPECT_LT(scalp.inside({0, -0.03F, 0.012F}), -0.05F);  // nose
  EXPECT_LT(scalp.inside({0.03F, -0.07F, -0.02F}), 0.0F);
  EXPECT_LT(scalp.inside({0, -0.115F, -0.09F}), 0.0F);  // neck
  const Eigen::Vector3f left(0.05F, 0.06F, -0.02F);
  EXPECT_FLOAT_EQ(scalp.inside(left), scalp.inside(left.cwiseProduct(Eigen::Vector3f(-1, 1, 1))));
}

}  // namespace
}  // namespace faceprobe::synth

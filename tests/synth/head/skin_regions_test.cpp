#include "faceprobe/synth/skin_regions.h"

#include "faceprobe/synth/procedural_head.h"

#include <gtest/gtest.h>

#include <map>

namespace faceprobe::synth {
namespace {

// The frontmost skin vertex near a point of the frontal view.
int vertex_near(const HeadModel& model, float x, float y) {
  int best = 0;
  float best_distance = 1;
  for (Eigen::Index t = 0; t < model.triangles.rows(); ++t) {
    if (model.triangle_material[static_cast<std::size_t>(t)] != Material::kSkin) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const int v = model.triangles(t, corner);
      const float distance = std::hypot(model.neutral(v, 0) - x, model.neutral(v, 1) - y);
      if (model.neutral(v, 2) > -0.06F && distance < best_distance) {
        best = v;
        best_distance = distance;
      }
    }
  }
  return best;
}

TEST(SkinRegions, KnownPlacesOfAFaceGetTheirRegion) {
  const HeadModel model = procedural_head();
  struct Place {
    float x, y;
    Region region;
  };
  const Place places[] = {
      {0, 0.060F, Region::kForehead},    {0.030F, 0.050F, Region::kForehead}, {0, -0.030F, Region::kNose},
      {0, -0.042F, Region::kNose},       {0.045F, -0.035F, Region::kCheeks},  {0, -0.0625F, Region::kUpperLip},
      {0, -0.083F, Region::kLips},       {0, -0.072F, Region::kLips},         {0, -0.105F, Region::kChin},
      {0.052F, -0.083F, Region::kJaw},   {0.0315F, 0.010F, Region::kEyelids}, {0.032F, -0.008F, Region::kEyelids},
      {0.035F, 0.0235F, Region::kBrows}, {0.020F, 0.0215F, Region::kBrows},   {0, -0.180F, Region::kOther},
      {0.080F, 0.000F, Region::kOther},  {0, 0.112F, Region::kOther},
  };
  for (const Place& place : places) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto v = static_cast<std::size_t>(vertex_near(model, side * place.x, place.y));
      EXPECT_EQ(model.vertex_region[v], place.region)
          << side * place.x << ' ' << place.y << ": " << region_name(model.vertex_region[v]);
    }
  }
}

TEST(SkinRegions, PartsThatAreNotSkinAreEyesAndMouth) {
  const HeadModel model = procedural_head();
  for (const SurfaceMesh& mesh : make_head(model, {}).figure.meshes) {
    std::map<Region, int> count;
    for (const Region region : mesh.vertex_region) ++count[region];
    if (mesh.material == Material::kEye) {
      EXPECT_EQ(count.size(), 1U);
      EXPECT_EQ(count.begin()->first, Region::kEyes);
    }
    if (mesh.material == Material::kTeeth) {
      EXPECT_EQ(count.size(), 1U);
      EXPECT_EQ(count.begin()->first, Region::kMouth);
    }
    if (mesh.material == Material::kSkin) {
      EXPECT_EQ(count.size(), static_cast<std::size_t>(kSkinRegionCount));  // every region of the skin, no other
      EXPECT_EQ(count.count(Region::kEyes) + count.count(Region::kMouth), 0U);
    }
  }
}

TEST(SkinRegions, FollowTheFaceWhenItIsScaledAndMoved) {
  HeadModel model = procedural_head();
  const std::vector<Region> before = regions_from_landmarks(model);
  model.neutral = (model.neutral * 2.0F).eval();  // exact in float, so no vertex changes sides
  EXPECT_EQ(regions_from_landmarks(model), before);
}

TEST(SkinRegions, WithoutLandmarksSkinIsOther) {
  HeadModel model = procedural_head();
  model.landmarks.clear();
  int eyes = 0;
  for (const Region region : regions_from_landmarks(model)) {
    EXPECT_TRUE(region == Region::kOther || region == Region::kEyes || region == Region::kMouth);
    eyes += region == Region::kEyes ? 1 : 0;
  }
  EXPECT_GT(eyes, 100);
}

}  // namespace
}  // namespace faceprobe::synth

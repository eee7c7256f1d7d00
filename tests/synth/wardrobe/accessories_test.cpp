#include "faceprobe/synth/wardrobe.h"

#include "synth/wardrobe/egg_head.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace faceprobe::synth {
namespace {

WardrobeSettings bald(std::uint64_t seed) {
  WardrobeSettings settings;
  settings.cut = HairCut::kBald;
  settings.seed = seed;
  return settings;
}

// Whether the ray meets the mesh (Moeller and Trumbore).
bool meets(const SurfaceMesh& mesh, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3f a = mesh.vertices.row(t(0)).transpose();
    const Eigen::Vector3f ab = mesh.vertices.row(t(1)).transpose() - a;
    const Eigen::Vector3f ac = mesh.vertices.row(t(2)).transpose() - a;
    const Eigen::Vector3f h = direction.cross(ac);
    const float det = ab.dot(h);
    if (std::abs(det) < 1e-14F) continue;
    const Eigen::Vector3f s = origin - a;
    const float u = s.dot(h) / det;
    const Eigen::Vector3f q = s.cross(ab);
    const float v = direction.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && ac.dot(q) / det > 0) return true;
  }
  return false;
}

Eigen::Vector3f eye(const Head& head, int first) {
  return head.landmarks.middleRows(first, 6).colwise().mean().transpose();
}

class Pairs : public testing::TestWithParam<Glasses> {};

TEST_P(Pairs, SitBeforeTheEyesOnBothSidesAlike) {
  const Head head = egg_head();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    WardrobeSettings settings = bald(seed);
    settings.glasses = GetParam();
    const Figure figure = dress(head, settings);
    const bool sun = GetParam() == Glasses::kSun;
    const SurfaceMesh* lens = nullptr;
    const SurfaceMesh* frame = nullptr;
    for (const SurfaceMesh& m : figure.meshes) {
      if (m.vertex_region[0] != Region::kGlasses) continue;
      if (m.material == (sun ? Material::kObject : Material::kLens)) lens = &m;
      if (m.material == Material::kFrame) frame = &m;
    }
    ASSERT_NE(lens, nullptr);
    ASSERT_NE(frame, nullptr);
    const float plane = 0.5F * (eye(head, 36).z() + eye(head, 42).z());
    EXPECT_LT((lens->vertices.col(2).array() - plane).abs().maxCoeff(), 0.03F);
    for (const int first : {36, 42}) {
      EXPECT_TRUE(meets(*lens, eye(head, first), {0, 0, 1}));
      EXPECT_FALSE(meets(*lens, eye(head, first), {0, 0, -1}));
      EXPECT_FALSE(meets(*frame, eye(head, first), {0, 0, 1}));  // the rim leaves the eye free
    }
    // Lenses look ahead.
    EXPECT_GT(lens->normals.col(2).minCoeff(), 0.5F);
    for (const auto& v : lens->vertices.rowwise()) EXPECT_GT(egg_level(v.transpose()), 1.0F);
    // Mirrored: each half's extent. 0.1 mm is float rounding through the splines.
    for (const SurfaceMesh* m : {lens, frame}) {
      EXPECT_NEAR(m->vertices.col(0).maxCoeff(), -m->vertices.col(0).minCoeff(), 1e-4F);
    }
    // The bars reach back to the ears, a hand's breadth behind the eyes.
    EXPECT_LT(frame->vertices.col(2).minCoeff(), plane - 0.05F);
  }
}
INSTANTIATE_TEST_SUITE_P(All, Pairs, testing::Values(Glasses::kRound, Glasses::kSquare, Glasses::kSun));

TEST(Accessories, MasksHatsAndHandsLeaveTheEyesFree) {
  const Head head = egg_head();
  constexpr std::array<Held, 4> kHeld = {Held::kMask, Held::kPhone, Held::kCup, Held::kMicrophone};
  constexpr std::array<Headwear, 3> kHeadwear = {Headwear::kBeanie, Headwear::kCap, Headwear::kScarf};
  for (int i = 0; i < 24; ++i) {
    WardrobeSettings settings = bald(static_cast<std::uint64_t>(i));
    settings.held = kHeld[static_cast<std::size_t>(i % 4)];
    settings.headwear = kHeadwear[static_cast<std::size_t>(i / 4 % 3)];
    const Figure figure = dress(head, settings);
    for (const SurfaceMesh& m : figure.meshes) {
      for (const int first : {36, 42}) {
        EXPECT_FALSE(meets(m, eye(head, first) + Eigen::Vector3f(0, 0, 0.001F), {0, 0, 1})) << i;
      }
    }
  }
}

TEST(Accessories, MaskCoversMouthAndNostrilsWithoutCuttingTheSkin) {
  const Head head = egg_head();
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    WardrobeSettings settings = bald(seed);
    settings.held = Held::kMask;
    const Figure figure = dress(head, settings);
    const SurfaceMesh* mask = nullptr;
    for (const SurfaceMesh& m : figure.meshes) {
      if (m.vertex_region[0] == Region::kObject) mask = &m;
    }
    ASSERT_NE(mask, nullptr);
    for (const int point : {33, 51, 57}) {
      EXPECT_TRUE(
          meets(*mask, head.landmarks.row(point).transpose() - Eigen::RowVector3f(0, 0, 0.01F).transpose(), {0, 0, 1}))
          << point;
    }
    int inside = 0;
    for (const auto& v : mask->vertices.rowwise()) {  // the loops end behind the ears, which an egg has not
      inside += v.z() > -0.06F && egg_level(v.transpose()) < 0.99F ? 1 : 0;
    }
    EXPECT_EQ(inside, 0);
  }
}

TEST(Accessories, BrimOfACapIsAboveTheEyesAndBeforeTheForehead) {
  const Head head = egg_head();
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    WardrobeSettings settings = bald(seed);
    settings.headwear = Headwear::kCap;
    const Figure figure = dress(head, settings);
    const SurfaceMesh* cap = nullptr;
    for (const SurfaceMesh& m : figure.meshes) {
      if (m.vertices.col(1).maxCoeff() > kEggRadii.y()) cap = &m;
    }
    ASSERT_NE(cap, nullptr);
    const float forehead = kEggCentre.z() + kEggRadii.z();
    EXPECT_GT(cap->vertices.col(2).maxCoeff(), forehead + 0.04F);
    for (const auto& v : cap->vertices.rowwise()) {
      if (v.z() > forehead) {
        EXPECT_GT(v.y(), eye(head, 36).y() + 0.004F);
      }
    }
  }
}

TEST(Accessories, ScarfCoversHairEarsAndNeck) {
  const Head head = egg_head();
  WardrobeSettings settings;
  settings.headwear = Headwear::kScarf;
  const Figure figure = dress(head, settings);
  for (const Strands& s : figure.strands) EXPECT_EQ(s.region, Region::kEyelids);
  const SurfaceMesh* scarf = nullptr;
  for (const SurfaceMesh& m : figure.meshes) {
    if (m.vertices.col(1).maxCoeff() > 0.1F) scarf = &m;
  }
  ASSERT_NE(scarf, nullptr);
  const Eigen::Vector3f middle(0, 0, -0.085F);
  EXPECT_TRUE(meets(*scarf, middle, {0, 1, 0}));
  EXPECT_TRUE(meets(*scarf, middle, {1, 0, -0.1F}));
  EXPECT_TRUE(meets(*scarf, middle, {-1, 0, -0.1F}));
  EXPECT_TRUE(meets(*scarf, middle, {0, 0, -1}));
  EXPECT_TRUE(meets(*scarf, {0, -0.13F, -0.095F}, {0, 0, 1}));  // throat
}

TEST(Accessories, HandsHaveTheSkinTone) {
  WardrobeSettings settings = bald(1);
  settings.held = Held::kHand;
  settings.skin_tone = {0.1F, 0.06F, 0.04F};
  for (const SurfaceMesh& m : dress(egg_head(), settings).meshes) {
    if (m.vertex_region[0] != Region::kObject) continue;
    const Eigen::RowVector3f mean = m.vertex_albedo.colwise().mean();
    // The mottling averages out to a few per cent over the hand.
    EXPECT_LE((mean.transpose() - settings.skin_tone).cwiseAbs().cwiseQuotient(settings.skin_tone).maxCoeff(), 0.08F);
    return;
  }
  FAIL() << "no hand";
}

}  // namespace
}  // namespace faceprobe::synth

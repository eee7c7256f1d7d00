#include "faceprobe/synth/wardrobe.h"

#include "synth/wardrobe/egg_head.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace faceprobe::synth {
namespace {

// Every array of a figure as bytes.
std::string bytes_of(const Figure& figure) {
  std::string bytes;
  const auto add = [&](const auto* data, auto count) {
    bytes.append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(count) * sizeof(*data));
  };
  for (const SurfaceMesh& m : figure.meshes) {
    add(m.vertices.data(), m.vertices.size());
    add(m.normals.data(), m.normals.size());
    add(m.triangles.data(), m.triangles.size());
    add(m.vertex_albedo.data(), m.vertex_albedo.size());
    add(m.reflectance.albedo.data(), 3);
  }
  for (const Strands& s : figure.strands) {
    add(s.points.data(), s.points.size());
    add(s.first_point.data(), s.first_point.size());
    add(s.tone.data(), s.tone.size());
  }
  return bytes;
}

void expect_sound(const Figure& figure) {
  for (const SurfaceMesh& m : figure.meshes) {
    ASSERT_GT(m.triangles.rows(), 0);
    EXPECT_TRUE(m.vertices.allFinite());
    EXPECT_GE(m.triangles.minCoeff(), 0);
    EXPECT_LT(m.triangles.maxCoeff(), m.vertices.rows());
    ASSERT_EQ(m.normals.rows(), m.vertices.rows());
    // Float rounding of a normalised vector.
    EXPECT_LE((m.normals.rowwise().norm().array() - 1.0F).abs().maxCoeff(), 1e-5F);
    EXPECT_EQ(static_cast<Eigen::Index>(m.vertex_region.size()), m.vertices.rows());
    if (m.vertex_albedo.rows() > 0) {
      ASSERT_EQ(m.vertex_albedo.rows(), m.vertices.rows());
      EXPECT_GE(m.vertex_albedo.minCoeff(), 0.0F);
      EXPECT_LE(m.vertex_albedo.maxCoeff(), 1.0F);
    }
    EXPECT_NE(m.material, Material::kSkin);  // the head's own
    EXPECT_NE(m.material, Material::kHair);  // strands only
  }
  for (const Strands& s : figure.strands) {
    EXPECT_TRUE(s.points.allFinite());
    EXPECT_GT(s.points.col(3).minCoeff(), 0.0F);
    ASSERT_EQ(s.first_point.size(), s.tone.size() + 1);
    EXPECT_EQ(s.first_point.front(), 0);
    EXPECT_EQ(s.first_point.back(), s.points.rows());
    for (std::size_t i = 1; i < s.first_point.size(); ++i) ASSERT_GE(s.first_point[i], s.first_point[i - 1] + 2);
    EXPECT_GE(s.reflectance.albedo.minCoeff(), 0.0F);
    EXPECT_LE(s.reflectance.albedo.maxCoeff(), 1.0F);
  }
}

WardrobeSettings combination(int i) {
  WardrobeSettings settings;
  settings.cut = static_cast<HairCut>(i % 8);
  settings.headwear = static_cast<Headwear>((i / 2) % 4);
  settings.glasses = static_cast<Glasses>((i + 1) % 4);
  settings.held = static_cast<Held>(i % 6);
  settings.beard = i % 3 == 0 ? 0.8F : 0.0F;
  settings.moustache = i % 2 == 0 ? 0.7F : 0.0F;
  settings.strands = 600;
  settings.seed = static_cast<std::uint64_t>(i);
  return settings;
}

TEST(Wardrobe, EverythingItMakesIsSound) {
  const Head head = egg_head();
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    expect_sound(dress(head, combination(i)));
  }
}

TEST(Wardrobe, AHeadWithoutLandmarksIsDressedToo) {
  const Head head = egg_head(false);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    expect_sound(dress(head, combination(i)));
  }
}

TEST(Wardrobe, AHeadTwiceTheSizeWearsTwiceTheSize) {
  const Head head = egg_head();
  Head large = head;
  large.figure.meshes[0].vertices *= 2.0F;
  large.landmarks *= 2.0F;
  WardrobeSettings settings;
  settings.glasses = Glasses::kSquare;
  settings.strands = 100;
  const auto width = [](const Figure& figure) {
    for (const SurfaceMesh& m : figure.meshes) {
      if (m.material == Material::kLens) return m.vertices.col(0).maxCoeff() - m.vertices.col(0).minCoeff();
    }
    return 0.0F;
  };
  EXPECT_NEAR(width(dress(large, settings)) / width(dress(head, settings)), 2.0F, 1e-3F);  // float rounding along the way
}

TEST(Wardrobe, TheSameSeedGivesTheSameBytesAndAnotherOnesOthers) {
  const Head head = egg_head();
  WardrobeSettings settings = combination(3);
  const std::string first = bytes_of(dress(head, settings));
  EXPECT_EQ(bytes_of(dress(head, settings)), first);
  ++settings.seed;
  EXPECT_NE(bytes_of(dress(head, settings)), first);
}

TEST(Wardrobe, ATorsoIsAlwaysThereAndBelowTheChin) {
  const Head head = egg_head();
  for (int seed = 0; seed < 12; ++seed) {
    WardrobeSettings settings;
    settings.cut = HairCut::kBald;
    settings.seed = static_cast<std::uint64_t>(seed);
    const Figure figure = dress(head, settings);
    ASSERT_EQ(figure.meshes.size(), 1U);
    const SurfaceMesh& torso = figure.meshes[0];
    EXPECT_EQ(torso.material, Material::kCloth);
    EXPECT_EQ(torso.vertex_region[0], Region::kClothes);
    // In front it starts under the chin; behind, collars reach up the neck.
    for (const auto& v : torso.vertices.rowwise()) {
      if (v.z() > kEggCentre.z()) {
        ASSERT_LT(v.y(), head.landmarks(8, 1));
      }
    }
    // Around the neck there is cloth at the height of its lower end, on every side: no hole is seen between the two.
    const float neck_end = head.figure.meshes[0].vertices.col(1).minCoeff();
    EXPECT_GT(torso.vertices.col(1).maxCoeff(), neck_end);
    EXPECT_LT(torso.vertices.col(1).minCoeff(), neck_end - 0.1F);
  }
}

TEST(Wardrobe, DrawsVaryAndKeepToTheirShares) {
  Random random({42});
  constexpr int kCount = 4000;
  int glasses = 0;
  int bald = 0;
  int hats = 0;
  int held = 0;
  int beards = 0;
  std::set<std::uint64_t> seeds;
  for (int i = 0; i < kCount; ++i) {
    const WardrobeSettings s = draw_wardrobe(random);
    glasses += s.glasses != Glasses::kNone ? 1 : 0;
    bald += s.cut == HairCut::kBald ? 1 : 0;
    hats += s.headwear != Headwear::kNone ? 1 : 0;
    held += s.held != Held::kNone ? 1 : 0;
    beards += s.beard > 0 ? 1 : 0;
    seeds.insert(s.seed);
    ASSERT_GE(s.hair_colour.minCoeff(), 0.0F);
    ASSERT_LE(s.hair_colour.maxCoeff(), 0.6F);
  }
  EXPECT_EQ(seeds.size(), static_cast<std::size_t>(kCount));
  // Four standard deviations of a share p of 4000: at most .032.
  EXPECT_NEAR(glasses / double{kCount}, 0.23, 0.03);
  EXPECT_NEAR(bald / double{kCount}, 0.07, 0.02);
  EXPECT_NEAR(hats / double{kCount}, 0.10, 0.02);
  EXPECT_NEAR(held / double{kCount}, 0.10, 0.02);
  EXPECT_NEAR(beards / double{kCount}, 0.19, 0.03);
}

TEST(Wardrobe, RefusesAHeadWithoutSkin) { EXPECT_THROW(dress(Head{}, {}), std::invalid_argument); }

}  // namespace
}  // namespace faceprobe::synth

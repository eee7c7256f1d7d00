#include "faceprobe/face/region.h"

#include "face/fixtures.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <set>

namespace faceprobe::face {
namespace {

std::array<double, kRegionCount> area_shares() {
  const CanonicalMesh& mesh = canonical_mesh();
  const std::vector<Region> regions = triangle_regions(mesh);
  std::array<double, kRegionCount> area{};
  double sum = 0;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3f a = mesh.vertices_m.row(mesh.triangles(t, 1)) - mesh.vertices_m.row(mesh.triangles(t, 0));
    const Eigen::Vector3f b = mesh.vertices_m.row(mesh.triangles(t, 2)) - mesh.vertices_m.row(mesh.triangles(t, 0));
    const auto size = static_cast<double>(a.cross(b).norm());
    area[static_cast<std::size_t>(regions[static_cast<std::size_t>(t)])] += size;
    sum += size;
  }
  for (double& value : area) value /= sum;
  return area;
}

TEST(Region, EveryTriangleHasOneAndAllAppear) {
  const std::vector<Region> regions = triangle_regions(canonical_mesh());
  ASSERT_EQ(regions.size(), 898U);
  EXPECT_EQ(std::ranges::count(regions, Region::kNone), 0);
  for (int r = 1; r <= static_cast<int>(Region::kMouth); ++r)
    EXPECT_GT(std::ranges::count(regions, static_cast<Region>(r)), 0) << r;
  EXPECT_LE(std::ranges::max(regions), Region::kMouth) << "hair and what is worn are not of the mesh";
}

TEST(Region, LeftMirrorsRight) {
  const CanonicalMesh& mesh = canonical_mesh();
  std::vector<int> mirror;
  for (int i = 0; i < kMeshVertices; ++i) {
    const Eigen::RowVector3f wanted = mesh.vertices_m.row(i).cwiseProduct(Eigen::RowVector3f(-1, 1, 1));
    Eigen::Index at = 0;
    EXPECT_LT((mesh.vertices_m.rowwise() - wanted).rowwise().norm().minCoeff(&at), 1e-4F);
    mirror.push_back(static_cast<int>(at));
  }
  const std::vector<Region> regions = triangle_regions(mesh);
  std::map<std::set<int>, Region> by_corners;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    by_corners[{mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)}] =
        regions[static_cast<std::size_t>(t)];
  }
  int compared = 0;
  for (const auto& [corners, region] : by_corners) {
    std::set<int> other;
    for (const int i : corners) other.insert(mirror[static_cast<std::size_t>(i)]);
    const auto found = by_corners.find(other);
    if (found == by_corners.end()) continue;  // a few quads are cut along the other diagonal
    EXPECT_EQ(found->second, region);
    ++compared;
  }
  EXPECT_GT(compared, 850);
}

TEST(Region, SharesOfTheSurfaceAreThoseOfAFace) {
  const std::array<double, kRegionCount> share = area_shares();
  const auto of = [&](Region region) { return share[static_cast<std::size_t>(region)]; };
  // Bounds from looking at faces: the cheeks are the largest, forehead next; lips and brows small.
  EXPECT_GT(of(Region::kCheeks), 0.2);
  EXPECT_LT(of(Region::kCheeks), 0.45);
  EXPECT_GT(of(Region::kForehead), 0.1);
  EXPECT_GT(of(Region::kNose), 0.04);
  EXPECT_LT(of(Region::kNose), 0.15);
  for (const Region small : {Region::kLips, Region::kBrows, Region::kUpperLip, Region::kEyes}) {
    EXPECT_GT(of(small), 0.005) << region_name(small);
    EXPECT_LT(of(small), 0.06) << region_name(small);
  }
  EXPECT_LT(of(Region::kMouth), 0.02) << "the canonical mouth is closed";
}

TEST(Region, KnownLandmarksLieInTheirRegions) {
  const CanonicalMesh& mesh = canonical_mesh();
  const std::vector<Region> regions = triangle_regions(mesh);
  // All triangles around these vertices.
  const std::map<int, Region> expected = {{4, Region::kNose},    {151, Region::kForehead}, {9, Region::kForehead},
                                          {50, Region::kCheeks}, {280, Region::kCheeks},   {205, Region::kCheeks},
                                          {199, Region::kChin},  {175, Region::kChin},     {195, Region::kNose}};
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (const auto at = expected.find(mesh.triangles(t, k)); at != expected.end()) {
        EXPECT_EQ(regions[static_cast<std::size_t>(t)], at->second) << "vertex " << at->first;
      }
    }
  }
}

TEST(Region, NamesAndColoursAreDistinct) {
  std::set<std::string_view> names;
  std::set<std::array<std::uint8_t, 3>> colours;
  int probe = 0;
  for (int r = 0; r < kRegionCount; ++r) {
    names.insert(region_name(static_cast<Region>(r)));
    colours.insert(region_colour(static_cast<Region>(r)));
    probe += is_probe_skin(static_cast<Region>(r)) ? 1 : 0;
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kRegionCount));
  EXPECT_EQ(colours.size(), static_cast<std::size_t>(kRegionCount));
  EXPECT_EQ(probe, 8);
}

// Pictures of regions come from files too: what is no region is no skin either.
TEST(Region, SkinIsTheTenRegionsAndNothingElse) {
  int skin = 0;
  for (int byte = 0; byte < 256; ++byte) {
    const auto region = static_cast<Region>(byte);
    skin += is_skin(region) ? 1 : 0;
    EXPECT_TRUE(is_skin(region) || !is_probe_skin(region)) << byte;
  }
  EXPECT_EQ(skin, kSkinRegionCount);
  EXPECT_TRUE(is_skin(Region::kLips) && is_skin(Region::kOther));
  EXPECT_FALSE(is_skin(Region::kNone) || is_skin(Region::kEyes));
}

}  // namespace
}  // namespace faceprobe::face

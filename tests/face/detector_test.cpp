#include "face/detector.h"

#include "face/search_plan.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <numbers>

namespace faceprobe::face {
namespace {

Detection box(float x, float y, float size, float score) {
  Detection detection;
  detection.centre = {x, y};
  detection.width = detection.height = size;
  detection.keypoints.fill(Eigen::Vector2f(x, y));
  detection.score = score;
  return detection;
}

TEST(Anchors, FillTheSquareEvenly) {
  for (const auto& [kind, count] :
       {std::pair{DetectorKind::kShortRange, 896}, std::pair{DetectorKind::kFullRange, 2304}}) {
    const std::vector<Eigen::Vector2f> anchors = anchor_centres(kind);
    ASSERT_EQ(anchors.size(), static_cast<std::size_t>(count));
    Eigen::Vector2f mean = Eigen::Vector2f::Zero();
    for (const Eigen::Vector2f& a : anchors) {
      EXPECT_GT(a.minCoeff(), 0);
      EXPECT_LT(a.maxCoeff(), 1);
      mean += a / static_cast<float>(count);
    }
    EXPECT_NEAR((mean - Eigen::Vector2f(0.5F, 0.5F)).norm(), 0, 1e-4);
  }
  EXPECT_EQ(anchor_centres(DetectorKind::kShortRange)[2], Eigen::Vector2f(1.5F / 16, 0.5F / 16)) << "x runs first";
  EXPECT_EQ(anchor_centres(DetectorKind::kShortRange)[512], Eigen::Vector2f(0.5F / 8, 0.5F / 8));
}

TEST(Merge, OverlapOfKnownBoxes) {
  EXPECT_FLOAT_EQ(intersection_over_union(box(0, 0, 2, 1), box(1, 0, 2, 1)), 2.0F / 6.0F);
  EXPECT_FLOAT_EQ(intersection_over_union(box(0, 0, 2, 1), box(0, 0, 2, 1)), 1);
  EXPECT_FLOAT_EQ(intersection_over_union(box(0, 0, 2, 1), box(5, 0, 2, 1)), 0);
}

TEST(Merge, AveragesByScoreAndKeepsStrangersApart) {
  const std::vector<Detection> out =
      merge_overlapping({box(10.4F, 0, 10, 0.25F), box(10, 0, 10, 0.75F), box(50, 0, 10, 0.9F)}, 0.3F);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_FLOAT_EQ(out[0].centre.x(), 50);
  EXPECT_NEAR(out[1].centre.x(), 10.1F, 1e-5);
  EXPECT_NEAR(out[1].keypoints[kNoseTip].x(), 10.1F, 1e-5);
  EXPECT_FLOAT_EQ(out[1].score, 0.75F);
  EXPECT_TRUE(merge_overlapping({}, 0.3F).empty());
}

TEST(Merge, RegionTurnsWithTheEyes) {
  Detection detection = box(100, 100, 40, 1);
  detection.keypoints[kRightEye] = {90, 90};
  detection.keypoints[kLeftEye] = {110, 110};  // right and down: the head is rolled clockwise by 45 degrees
  const SquareRegion square = mesh_region(detection);
  EXPECT_NEAR(square.angle, std::numbers::pi / 4, 1e-6);
  EXPECT_FLOAT_EQ(square.side, 60);
  const Eigen::Vector2f along = square.photo_from_unit(1, 0.5F) - square.photo_from_unit(0, 0.5F);
  EXPECT_NEAR((along.normalized() - Eigen::Vector2f(1, 1).normalized()).norm(), 0, 1e-6);
}

TEST(SearchPlan, SmallPhotosNeedNoTiles) {
  EXPECT_TRUE(plan_tiles(640, 480, 60, 32).empty());
  EXPECT_TRUE(plan_tiles(4000, 3000, 400, 32).empty());
}

TEST(SearchPlan, EveryFaceLiesWholeInATileThatSeesIt) {
  const std::vector<SquareRegion> tiles = plan_tiles(4000, 3000, 90, 200);
  ASSERT_FALSE(tiles.empty());
  for (const float size : {90.0F, 120.0F, 170.0F, 249.0F}) {  // those below a sixteenth of 4000
    for (float y = size / 2; y < 3000 - size / 2; y += 37) {
      for (float x = size / 2; x < 4000 - size / 2; x += 41) {
        const bool seen = std::ranges::any_of(tiles, [&](const SquareRegion& t) {
          const float reach = 0.5F * (t.side - size) + 0.01F;
          return size >= t.side / 16.01F && std::abs(x - t.centre.x()) <= reach && std::abs(y - t.centre.y()) <= reach;
        });
        ASSERT_TRUE(seen) << size << " px at " << x << ' ' << y;
      }
    }
  }
}

TEST(SearchPlan, IsBounded) {
  for (const auto& [width, height] : {std::pair{12000, 9000}, std::pair{30000, 400}, std::pair{400, 30000}}) {
    const std::vector<SquareRegion> tiles = plan_tiles(width, height, 16, 32);
    EXPECT_FALSE(tiles.empty());
    EXPECT_LE(tiles.size(), 32U);
  }
}

}  // namespace
}  // namespace faceprobe::face

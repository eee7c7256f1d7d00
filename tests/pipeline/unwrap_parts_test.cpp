#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sh.h"
#include "pipeline/unwrap_fill.h"
#include "pipeline/unwrap_raster.h"
#include "pipeline/unwrap_shading.h"
#include "pipeline/unwrap_warp.h"

#include <gtest/gtest.h>
#include <cmath>

namespace faceprobe::pipeline {
namespace {

Eigen::MatrixX2f scattered(int count, std::uint64_t seed) {
  Random random({seed});
  Eigen::MatrixX2f points(count, 2);
  for (int i = 0; i < count; ++i) {
    points(i, 0) = static_cast<float>(random.between(0, 500));
    points(i, 1) = static_cast<float>(random.between(0, 500));
  }
  return points;
}

TEST(ThinPlateWarp, GoesThroughItsPointsAndKeepsAffineMaps) {
  const Eigen::MatrixX2f from = scattered(60, 1);
  Eigen::Matrix2f turn;
  turn << 1.1F, 0.2F, -0.1F, 0.9F;
  Eigen::MatrixX2f to = from * turn;
  to.rowwise() += Eigen::RowVector2f(7, -3);
  const ThinPlateWarp affine(from, to, 0.1);
  const Eigen::Vector2f elsewhere(700, -100);
  // Float coordinates of several hundred: 1e-7 of them, and the solve.
  EXPECT_LT((affine(elsewhere) - (turn.transpose() * elsewhere + Eigen::Vector2f(7, -3))).norm(), 2e-3F);

  const Eigen::MatrixX2f bent = to + 0.02F * scattered(60, 2);
  const ThinPlateWarp exact(from, bent, 0.0);
  const ThinPlateWarp soft(from, bent, 1.0);
  double soft_error = 0;
  for (int i = 0; i < 60; ++i) {
    EXPECT_LT((exact(from.row(i).transpose()) - bent.row(i).transpose()).norm(), 2e-3F);
    soft_error += static_cast<double>((soft(from.row(i).transpose()) - bent.row(i).transpose()).norm()) / 60;
  }
  EXPECT_GT(soft_error, 0.1);
}

TEST(PushPull, KeepsWhatIsKnownAndStaysWithinIt) {
  Image picture(37, 23, 2);
  Image weight(37, 23, 1);
  Random random({3});
  for (int i = 0; i < 60; ++i) {
    const int x = random.below(37);
    const int y = random.below(23);
    weight(x, y) = 1.0F;
    picture(x, y, 0) = static_cast<float>(random.between(2, 3));
    picture(x, y, 1) = 5.0F;
  }
  const Image full = push_pull(picture, weight);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      if (weight(x, y) > 0) {
        EXPECT_EQ(full(x, y, 0), picture(x, y, 0));
      }
      // Means of means; float rounding.
      EXPECT_GT(full(x, y, 0), 2.0F - 1e-4F);
      EXPECT_LT(full(x, y, 0), 3.0F + 1e-4F);
      EXPECT_NEAR(full(x, y, 1), 5.0F, 1e-4F);
    }
  }
  EXPECT_EQ(push_pull(picture, Image(37, 23, 1)), picture);
}

TEST(SlowShading, OfSecondOrderIsTakenOutPastFeatures) {
  constexpr int kSide = 96;
  Image normal(kSide, kSide, 3);
  Image colour(kSide, kSide, 3);
  Eigen::VectorXd light(9);
  light << 0, 1.0, 1.2, -1.6, 0.4, -0.4, 0.6, 0.8, -0.2;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double nx = 1.6 * ((x + 0.5) / kSide - 0.5);
      const double ny = 1.2 * (0.5 - (y + 0.5) / kSide);
      const Eigen::Vector3d n = Eigen::Vector3d(nx, ny, 1).normalized();
      Eigen::Map<Eigen::Vector3f>(normal.pixel(x, y)) = n.cast<float>();
      const bool feature = x > 20 && x < 40 && y > 10 && y < 20;
      const double value = std::exp(light.dot(sh::basis(2, n))) * (feature ? 0.2 : 1.0);
      for (int c = 0; c < 3; ++c) colour(x, y, c) = static_cast<float>((0.5 - 0.1 * c) * value);
    }
  }
  const auto range = [&colour] {
    float low = 1e9F;
    float high = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (x > 20 && x < 40 && y > 10 && y < 20) continue;
        low = std::min(low, luminance(colour.pixel(x, y)));
        high = std::max(high, luminance(colour.pixel(x, y)));
      }
    }
    return std::log(high / low);
  };
  const float before = range();
  const double taken = remove_slow_shading(normal, Image(kSide, kSide, 1, 1.0F), colour);
  EXPECT_GT(taken, 0.1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      EXPECT_NEAR(colour(x, y, 1) / colour(x, y, 0), 0.8F, 1e-5F);  // one gain for all channels
  }
  // What stays is the ridge's pull and what the feature, a fiftieth of the area, still weighs.
  EXPECT_LT(range(), 0.15F * before);
}

TEST(MeshRaster, NearestTriangleWinsWithItsWeights) {
  Eigen::MatrixX3f points(6, 3);
  points << 0, 0, 2, 10, 0, 2, 0, 10, 2, 0, 0, 1, 5, 0, 1, 0, 5, 1;
  Eigen::MatrixX3i triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  const MeshRaster raster = raster_mesh(points, triangles, {0, 1}, 10, 10);
  EXPECT_EQ(raster.at(1, 1).triangle, 1);
  EXPECT_EQ(raster.at(4, 4).triangle, 0);
  EXPECT_EQ(raster.at(9, 9).triangle, -1);
  EXPECT_TRUE(raster.at(4, 4).weights.isApprox(Eigen::Vector3f(0.1F, 0.45F, 0.45F), 1e-5F));
}

}  // namespace
}  // namespace faceprobe::pipeline

#include "face/raster.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace faceprobe::face {
namespace {

// y down on the screen: counter-clockwise as seen is (left bottom, right bottom, top).
Eigen::MatrixX2d triangle_px() {
  Eigen::MatrixX2d px(3, 2);
  px << 1, 9, 9, 9, 1, 1;
  return px;
}

TEST(Raster, WeightsAreAffineAtEqualDepth) {
  const auto out =
      rasterize_triangles(triangle_px(), Eigen::VectorXd::Constant(3, 2.0), Eigen::RowVector3i(0, 1, 2), 10, 10);
  int filled = 0;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      const Fragment& f = out[static_cast<std::size_t>(y * 10 + x)];
      if (f.triangle < 0) continue;
      ++filled;
      const Eigen::Vector2d there = triangle_px().transpose() * f.weights.cast<double>();
      EXPECT_NEAR((there - Eigen::Vector2d(x + 0.5, y + 0.5)).norm(), 0, 1e-5);  // float weights times 9 px
    }
  }
  EXPECT_EQ(filled,
            36);  // 8 x 8 / 2 and half of the diagonal of 8 pixel centres, which lie on the edge and count as inside
}

TEST(Raster, WeightsFollowPerspective) {
  // Corners of one plane at depths 1 and 3: halfway along the screen edge the surface point divides the edge 3 : 1.
  Eigen::MatrixX2d px(3, 2);
  px << 0, 20, 20, 20, 0, -20;
  const Eigen::Vector3d depths(1, 3, 1);
  const auto out = rasterize_triangles(px, depths, Eigen::RowVector3i(0, 1, 2), 20, 20);
  const Fragment& f = out[19 * 20 + 9];  // centre (9.5, 19.5)
  ASSERT_GE(f.triangle, 0);
  const double on_screen_1 = 9.5 / 20;
  const double on_screen_2 = 0.5 / 40;
  const double on_screen_0 = 1 - on_screen_1 - on_screen_2;
  const double sum = on_screen_0 + on_screen_1 / 3 + on_screen_2;
  EXPECT_NEAR(f.weights(1), on_screen_1 / 3 / sum, 1e-6);
  EXPECT_NEAR(f.weights.sum(), 1, 1e-6);
}

TEST(Raster, NearestWinsInEitherOrder) {
  Eigen::MatrixX2d px(6, 2);
  px << triangle_px(), triangle_px();
  Eigen::VectorXd depths(6);
  depths << 2, 2, 2, 1, 1, 1;
  Eigen::MatrixX3i triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  EXPECT_EQ(rasterize_triangles(px, depths, triangles, 10, 10)[8 * 10 + 2].triangle, 1);
  triangles.row(0).swap(triangles.row(1));
  EXPECT_EQ(rasterize_triangles(px, depths, triangles, 10, 10)[8 * 10 + 2].triangle, 0);
}

TEST(Raster, LeavesOutBackFacesAndWhatIsBehindTheCamera) {
  const auto any = [](const std::vector<Fragment>& out) {
    return std::ranges::any_of(out, [](const Fragment& f) { return f.triangle >= 0; });
  };
  const Eigen::VectorXd front = Eigen::VectorXd::Constant(3, 1.0);
  EXPECT_TRUE(any(rasterize_triangles(triangle_px(), front, Eigen::RowVector3i(0, 1, 2), 10, 10)));
  EXPECT_FALSE(any(rasterize_triangles(triangle_px(), front, Eigen::RowVector3i(0, 2, 1), 10, 10)));
  EXPECT_FALSE(any(rasterize_triangles(triangle_px(), Eigen::Vector3d(1, 1, -1), Eigen::RowVector3i(0, 1, 2), 10, 10)));
}

TEST(Raster, NeighboursLeaveNoGap) {
  Eigen::MatrixX2d px(4, 2);
  px << 0.2, 9.7, 9.9, 9.1, 9.3, 0.4, 0.6, 0.1;
  Eigen::MatrixX3i triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const auto out = rasterize_triangles(px, Eigen::VectorXd::Ones(4), triangles, 10, 10);
  for (int y = 1; y < 9; ++y) {
    for (int x = 1; x < 9; ++x) EXPECT_GE(out[static_cast<std::size_t>(y * 10 + x)].triangle, 0) << x << ' ' << y;
  }
}

TEST(Raster, VertexNormalOfACubeCornerIgnoresItsTriangulation) {
  // The corner of three square faces; one of them cut into two triangles there. Weighing by angle, each face counts 90
  // degrees.
  Eigen::MatrixX3f v(8, 3);
  v << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 0;
  Eigen::MatrixX3i t(4, 3);
  t << 0, 2, 4, 0, 4, 1,  // z = 0, seen from -z, split at the corner
      0, 1, 3,            // y = 0
      0, 3, 2;            // x = 0
  const Eigen::Vector3f normal = vertex_normals(v, t).row(0);
  EXPECT_NEAR((normal - Eigen::Vector3f::Constant(-1).normalized()).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace faceprobe::face

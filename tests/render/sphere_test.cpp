#include "faceprobe/render/sphere.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

namespace faceprobe::render {
namespace {

TEST(Sphere, WhiteFurnace) {
  const SphereGrid grid(16);
  const Eigen::MatrixX3f uniform = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 1.0F);
  const Image diffuse = render_sphere(uniform, grid, {.material = SphereMaterial::kDiffuse, .size_px = 33});
  const Image mirror = render_sphere(uniform, grid, {.material = SphereMaterial::kMirror, .size_px = 33});
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 33; ++x) {
      if (diffuse(x, y, 3) < 1.0F) continue;
      EXPECT_NEAR(diffuse(x, y), 1.0F, 0.005F);  // quadrature of a cosine on 3072 cells
      EXPECT_NEAR(mirror(x, y), 1.0F, 1e-5F);
    }
  }
}

TEST(Sphere, LampAtCameraRightLightsTheRightSide) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f lamp = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  const int cell = grid.cell_of({1, 0, 0});
  lamp(cell, 0) = 1.0F / static_cast<float>(grid.cell_solid_angle());
  const Image diffuse = render_sphere(lamp, grid, {.material = SphereMaterial::kDiffuse, .size_px = 65});
  // Lambert under one distant light of unit irradiance: max(0, n.l) / pi, with n.x = place on the ball's equator.
  for (const int x : {36, 44, 60}) {
    const double nx = 2.0 * (x + 0.5) / 65 - 1;
    const Eigen::Vector3d normal(nx, 0, std::sqrt(1 - nx * nx));
    EXPECT_NEAR(diffuse(x, 32, 0), normal.dot(grid.direction(cell).cast<double>()) / kPi, 1e-3);
  }
  EXPECT_EQ(diffuse(10, 32, 0), 0.0F);
  EXPECT_EQ(diffuse(60, 32, 1), 0.0F);
}

TEST(Sphere, MirrorShowsALightWhereItsHalfVectorPoints) {
  const SphereGrid grid(16);
  const Eigen::Vector3f light = direction_from_angles(60, 30).cast<float>();
  Eigen::MatrixX3f lamp = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  lamp(grid.cell_of(light), 1) = 1.0F;
  const Image mirror = render_sphere(lamp, grid, {.material = SphereMaterial::kMirror, .size_px = 256});
  int best_x = 0;
  int best_y = 0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      if (mirror(x, y, 1) > mirror(best_x, best_y, 1)) {
        best_x = x;
        best_y = y;
      }
    }
  }
  const Eigen::Vector3f half = (light + Eigen::Vector3f(0, 0, 1)).normalized();
  // A cell is 3.7 degrees wide, its reflection half of that: 4 pixels of 256.
  EXPECT_NEAR(best_x, 128 + 128 * half.x(), 5);
  EXPECT_NEAR(best_y, 128 - 128 * half.y(), 5);
}

TEST(Sphere, SameForAnyNumberOfThreads) {
  const SphereGrid grid(4);
  const Eigen::MatrixX3f radiance = (Eigen::MatrixX3f::Random(grid.cell_count(), 3).array() + 1.0F).matrix();
  EXPECT_EQ(render_sphere(radiance, grid, {.material = SphereMaterial::kMatte, .size_px = 40, .threads = 1}),
            render_sphere(radiance, grid, {.material = SphereMaterial::kMatte, .size_px = 40, .threads = 3}));
}

}  // namespace
}  // namespace faceprobe::render

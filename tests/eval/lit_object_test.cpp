#include "faceprobe/eval/lit_object.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr int kSize = 40;

Eigen::MatrixX3f constant(const SphereGrid& grid, float level) {
  return Eigen::MatrixX3f::Constant(grid.cell_count(), 3, level);
}

// Two squares that face the viewer: a large one, and a small one before its middle.
synth::SurfaceMesh screen_before_a_wall() {
  synth::SurfaceMesh mesh;
  mesh.vertices.resize(8, 3);
  mesh.vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -0.2F, -0.2F, 0.5F, 0.2F, -0.2F, 0.5F, 0.2F, 0.2F, 0.5F,
      -0.2F, 0.2F, 0.5F;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  mesh.normals = Eigen::RowVector3f(0, 0, 1).replicate(8, 1);
  return mesh;
}

// In light that is the same from everywhere a white convex thing cannot be seen: neither surface nor coat takes any.
TEST(LitObject, AWhiteSphereInAFurnaceIsWhite) {
  const LitObject sphere(sphere_mesh(), {.size_px = kSize});
  const LitPictures lit = sphere.light(constant(SphereGrid(16), 0.7F));
  int seen = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (sphere.mask()(x, y) == 0) {
        EXPECT_EQ(lit.diffuse(x, y, 0), 0);
        continue;
      }
      ++seen;
      // The sum over 3072 cells cut by the horizon: a cell is 0.03 % of the half sphere, and few lie on the cut.
      EXPECT_NEAR(lit.diffuse(x, y, 1), 0.7F, 0.7F * 0.005F);
      EXPECT_NEAR(lit.glossy(x, y, 1), 0.7F, 0.7F * 0.005F);
    }
  }
  EXPECT_NEAR(seen, kPi / 4 * kSize * kSize, 0.03 * kSize * kSize);  // pixels on the rim
}

TEST(LitObject, ALampFollowsTheCosineAndIsMirrored) {
  const SphereGrid grid(16);
  const int cell = grid.cell_of(Eigen::Vector3f(0.6F, 0.3F, 0.7F).normalized());
  const Eigen::Vector3f lamp = grid.direction(cell);
  Eigen::MatrixX3f light = constant(grid, 0);
  light.row(cell).setConstant(100);
  const LitObject sphere(sphere_mesh(192), {.size_px = kSize});
  const LitPictures lit = sphere.light(light);
  const double gain = 100 * grid.cell_solid_angle() / kPi;
  Eigen::Vector3f brightest = Eigen::Vector3f::Zero();
  float most = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (sphere.mask()(x, y) == 0) continue;
      const double u = 2 * (x + 0.5) / kSize - 1;
      const double v = 1 - 2 * (y + 0.5) / kSize;
      const Eigen::Vector3d normal(u, v, std::sqrt(std::max(0.0, 1 - u * u - v * v)));
      if (normal.z() < 0.3) continue;  // nearer the rim the facets show
      const double expected = gain * std::max(0.0, normal.dot(lamp.cast<double>()));
      EXPECT_NEAR(lit.diffuse(x, y, 2), expected, 0.02 * gain);  // facets of one degree
      if (lit.glossy(x, y, 0) > most) {
        most = lit.glossy(x, y, 0);
        brightest = normal.cast<float>();
      }
    }
  }
  const Eigen::Vector3f half = (lamp + Eigen::Vector3f::UnitZ()).normalized();
  EXPECT_LT(degrees(std::acos(std::min(1.0F, half.dot(brightest)))), 5);  // a pixel is three degrees
}

TEST(LitObject, WhatStandsBeforeALampThrowsAShadow) {
  const SphereGrid grid(16);
  const int cell = grid.cell_of(Eigen::Vector3f(0.7F, 0, 0.7F));
  const Eigen::Vector3f lamp = grid.direction(cell);
  Eigen::MatrixX3f light = constant(grid, 0);
  light.row(cell).setOnes();
  const LitObject wall(screen_before_a_wall(), {.size_px = kSize});
  const Image lit = wall.light(light).diffuse;
  const auto at = [&](double x, double y) {
    return lit(static_cast<int>((x + 1) / 2 * kSize), static_cast<int>((1 - y) / 2 * kSize), 0);
  };
  const double shift = 0.5 * static_cast<double>(lamp.x() / lamp.z());  // of the shadow, to the other side
  const auto open = static_cast<float>(grid.cell_solid_angle() / kPi) * lamp.z();
  EXPECT_EQ(at(-shift, 0), 0);
  EXPECT_NEAR(at(shift, 0), open, 1e-5F);
  EXPECT_NEAR(at(0, 0), open, 1e-5F);  // on the screen itself
  EXPECT_NEAR(at(-shift, 0.5), open, 1e-5F);
}

TEST(LitObject, OneThreadSaysWhatManySay) {
  Eigen::MatrixX3f light = constant(SphereGrid(16), 1);
  light.row(100).setConstant(50);
  const LitPictures one = LitObject(screen_before_a_wall(), {.size_px = 16, .threads = 1}).light(light);
  const LitPictures three = LitObject(screen_before_a_wall(), {.size_px = 16, .threads = 3}).light(light);
  EXPECT_EQ(one.diffuse, three.diffuse);
  EXPECT_EQ(one.glossy, three.glossy);
}

TEST(LitObject, RefusesWhatIsNoObject) {
  EXPECT_THROW(LitObject(synth::SurfaceMesh{}), std::invalid_argument);
  EXPECT_THROW(LitObject(sphere_mesh(), {.size_px = 0}), std::invalid_argument);
  EXPECT_THROW(LitObject(sphere_mesh(), {.size_px = 16}).light(Eigen::MatrixX3f::Ones(5, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::eval

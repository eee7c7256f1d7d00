#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/egg_head.h"
#include "synth/wardrobe/shapes.h"
#include "synth/wardrobe/skin_field.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace faceprobe::synth {
namespace {

SurfaceMesh sphere(float radius) {
  MeshBuilder builder;
  builder.ellipsoid({0, 0, 0}, Eigen::Matrix3f::Identity() * radius, 40, 60);
  return builder.take(Material::kObject, Region::kObject, {});
}

// By the divergence theorem; positive when triangles face outwards.
float volume(const SurfaceMesh& mesh) {
  float sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3f a = mesh.vertices.row(t(0)).transpose();
    const Eigen::Vector3f b = mesh.vertices.row(t(1)).transpose();
    const Eigen::Vector3f c = mesh.vertices.row(t(2)).transpose();
    sum += a.dot(b.cross(c)) / 6.0F;
  }
  return sum;
}

TEST(Shapes, FaceOutwardsAndHaveTheirVolumes) {
  const float pi = 3.14159265F;
  // A polyhedron of 40 x 60 loses (pi / 40)^2 / 2 + (2 pi / 60)^2 / 6 of a sphere: 0.5 %.
  EXPECT_NEAR(volume(sphere(1.0F)) / (4.0F / 3.0F * pi), 1.0F, 0.01F);
  MeshBuilder ring;
  std::vector<Eigen::Vector3f> path;
  for (int i = 0; i < 120; ++i)
    path.emplace_back(std::cos(2 * pi * static_cast<float>(i) / 120), std::sin(2 * pi * static_cast<float>(i) / 120), 0);
  ring.tube(path, 0.1F, 24, true);
  // A torus; 24 sides lose (2 pi / 24)^2 / 6 = 1.1 % of the circle.
  EXPECT_NEAR(volume(ring.take(Material::kObject, Region::kObject, {})) / (2 * pi * pi * 0.01F), 1.0F, 0.015F);
  MeshBuilder box;
  box.rounded_box({0, 0, 0}, Eigen::Vector3f(1, 2, 3).asDiagonal(), 12.0F, 10);
  const float filled = volume(box.take(Material::kObject, Region::kObject, {})) / 48.0F;
  EXPECT_GT(filled, 0.85F);
  EXPECT_LT(filled, 1.0F);
}

TEST(SkinField, MeasuresASphere) {
  const SurfaceMesh ball = sphere(0.08F);
  SkinField field(Eigen::Vector3f::Constant(-0.12F), Eigen::Vector3f::Constant(0.12F), 0.006F);
  field.add(ball);
  field.finish();
  Random random({3});
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f d = random.direction();
    const auto off = static_cast<float>(random.between(-0.005, 0.005));
    // Trilinear between nodes 6 mm apart, each right to the distance to a tangent plane: h^2 / (8 r) and the like, below 0.7 mm.
    EXPECT_NEAR(field.distance(d * (0.08F + off)), off, 0.0007F);
    EXPECT_GT(field.distance(d * 0.11F), 0.01F);
    EXPECT_LT(field.distance(d * 0.03F), -0.01F);
    Eigen::Vector3f p = d * 0.077F;
    EXPECT_TRUE(field.push_out(p, 0.002F));
    EXPECT_NEAR(p.norm(), 0.082F, 0.0009F);
  }
}

TEST(Anatomy, FindsTheEggsParts) {
  for (const bool landmarks : {true, false}) {
    const Anatomy a = measure(egg_head(landmarks));
    EXPECT_NEAR(a.scale, 1.0F, 0.12F);
    // Measured above the brows, where the egg is 2 % narrower.
    EXPECT_NEAR(a.skull_radii.x(), kEggRadii.x(), 0.004F);
    EXPECT_NEAR(a.skull_radii.z(), kEggRadii.z(), 0.004F);
    EXPECT_NEAR(a.skull_centre.z(), kEggCentre.z(), 0.002F);
    EXPECT_NEAR(a.skull_centre.y() + a.skull_radii.y(), kEggRadii.y(), 0.001F);
    EXPECT_NEAR(a.neck_radius, 0.055F, 0.012F);
    EXPECT_LT(a.ear_bottom, a.ear_top);
    EXPECT_LT(a.ear_back, a.ear_front);
  }
}

}  // namespace
}  // namespace faceprobe::synth

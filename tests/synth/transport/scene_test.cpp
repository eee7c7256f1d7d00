#include "faceprobe/synth/scene.h"

#include "faceprobe/core/random.h"
#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::synth {
namespace {

Strands one_hair(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius) {
  Strands hair;
  hair.points.resize(3, 4);
  hair.points.row(0) << from.transpose(), radius;
  hair.points.row(1) << 0.5F * (from + to).transpose(), radius;
  hair.points.row(2) << to.transpose(), radius;
  hair.first_point = {0, 3};
  hair.tone = {0.8F};
  return hair;
}

TEST(Scene, RayMeetsTheBallWhereGeometrySays) {
  const Scene scene = scene_of({ball(0.1F, 100)});
  Random random({1});
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f d = random.direction();
    const Hit hit = scene.first_hit(d, -d);
    ASSERT_EQ(hit.figure, 0);
    // A facet lies below the ball by at most r (pi / rings)^2 / 4.
    EXPECT_NEAR(hit.distance, 0.9F, 0.1F * 0.00025F);
    const Eigen::RowVector3i corners = scene.figures()[0].meshes[0].triangles.row(hit.primitive);
    const Eigen::RowVector3f point = (1 - hit.u - hit.v) * scene.vertices().row(corners(0)) +
                                     hit.u * scene.vertices().row(corners(1)) + hit.v * scene.vertices().row(corners(2));
    EXPECT_LE((point.transpose() - (d - hit.distance * d)).norm(), 1e-6F);
  }
}

TEST(Scene, ShortRaysStopBeforeTheBall) {
  const Scene scene = scene_of({ball(0.1F, 20)});
  EXPECT_TRUE(scene.occluded({0, 0, 1}, {0, 0, -1}));
  EXPECT_FALSE(scene.occluded({0, 0, 1}, {0, 0, -1}, 0, 0.85F));
  EXPECT_FALSE(scene.occluded({0, 0, 1}, {0, 0, -1}, 1.15F));
  EXPECT_EQ(scene.first_hit({0, 0, 1}, {0, 0, -1}, 0, 0.85F).figure, -1);
}

TEST(Scene, ManyRaysSeeWhatSingleOnesSee) {
  const Scene scene = scene_of({ball(0.1F, 30), ball(0.05F, 20, {0.2F, 0, 0})},
                               {one_hair({-0.3F, -0.3F, 0}, {-0.2F, 0.4F, 0.1F}, 0.02F)});
  Random random({2});
  Eigen::MatrixX3f directions(1001, 3);  // more than one stream, and a rest
  for (Eigen::Index i = 0; i < directions.rows(); ++i) directions.row(i) = random.direction().transpose();
  const Eigen::Vector3f origin(0, 0, 0.25F);
  std::vector<std::uint8_t> free(1001, 7);
  scene.visible(origin, directions, free.data());
  int seen = 0;
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(free[k], scene.occluded(origin, directions.row(i).transpose()) ? 0 : 1);
    seen += free[k];
  }
  EXPECT_GT(seen, 500);
  EXPECT_LT(seen, 1000);
}

TEST(Scene, LensesLetLightAndSightThrough) {
  SurfaceMesh lens = wall(0.05F, 2, 0.5F);
  lens.material = Material::kLens;
  const Scene scene = scene_of({ball(0.1F, 20), lens});
  EXPECT_FALSE(scene.occluded({0.04F, 0.04F, 1}, {0, 0, -1}, 0, 0.7F));
  EXPECT_EQ(scene.first_hit({0, 0, 1}, {0, 0, -1}).part, 0);
  const Hit with_lens = scene.first_hit({0, 0, 1}, {0, 0, -1}, 0, 2, true);
  EXPECT_EQ(with_lens.part, 1);
  EXPECT_NEAR(with_lens.distance, 0.5F, 1e-6F);
}

TEST(Scene, HairsAreAsWideAsTheirRadius) {
  const Scene scene = scene_of({}, {one_hair({0, -1, 0}, {0, 1, 0}, 0.01F)});
  const Hit hit = scene.first_hit({0.009F, 0.5F, 1}, {0, 0, -1});
  ASSERT_EQ(hit.figure, 0);
  EXPECT_TRUE(hit.strand);
  EXPECT_EQ(hit.primitive, 1);
  EXPECT_NEAR(hit.u, 0.5F, 1e-4F);
  EXPECT_EQ(scene.first_hit({0.011F, 0.5F, 1}, {0, 0, -1}).figure, -1);
}

TEST(Scene, NumbersVerticesOfAllMeshes) {
  const Scene scene({Figure{{ball(0.1F, 4), ball(0.2F, 5)}, {}}, Figure{{ball(0.3F, 6)}, {}}});
  EXPECT_EQ(scene.vertex_offset(0, 0), 0);
  EXPECT_EQ(scene.vertex_offset(0, 1), 34);
  EXPECT_EQ(scene.vertex_offset(1, 0), 34 + 52);
  EXPECT_EQ(scene.vertex_count(), 34 + 52 + 74);
  EXPECT_NEAR(scene.vertices().row(40).norm(), 0.2F, 1e-6F);
}

TEST(Scene, RefusesBrokenMeshes) {
  SurfaceMesh wrong_corner = ball(0.1F, 4);
  wrong_corner.triangles(3, 1) = 34;
  EXPECT_THROW(scene_of({wrong_corner}), std::invalid_argument);
  SurfaceMesh no_normals = ball(0.1F, 4);
  no_normals.normals.resize(0, 3);
  EXPECT_THROW(scene_of({no_normals}), std::invalid_argument);
  Strands wrong_point = one_hair({0, 0, 0}, {0, 1, 0}, 0.01F);
  wrong_point.first_point = {0, 4};
  EXPECT_THROW(scene_of({}, {wrong_point}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::synth

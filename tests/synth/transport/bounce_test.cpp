#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

// Floor (facing +y) and wall (facing +z) that meet at a right angle.
SurfaceMesh floor_of(float half_width, int n) {
  SurfaceMesh mesh = wall(half_width, n, 0);
  const Eigen::MatrixX3f flat = mesh.vertices;
  mesh.vertices.col(1).setConstant(-half_width);
  mesh.vertices.col(2) = half_width - flat.col(1).array();
  mesh.normals = Eigen::RowVector3f(0, 1, 0).replicate(flat.rows(), 1);
  return mesh;
}

Stage corner(int rays, int nside = 16) {
  PinholeCamera camera = camera_at(1.0F, 0.15F, 48);
  // From above, so that both are seen.
  camera.camera_from_scene = Eigen::AngleAxisf(0.6F, Eigen::Vector3f::UnitX()) * Eigen::Translation3f(0, -0.6F, -0.9F);
  return make_stage(scene_of({wall(0.1F, 24, 0), floor_of(0.1F, 24)}), camera, 0.3F,
                    {.nside = nside, .bounce_rays = rays});
}

TEST(Bounce, RightAngleExchangesTheLightOfItsFormFactor) {
  const Stage stage = corner(64);
  // The wall's row that is nearest to the middle of its lower edge, 8.3 mm above the floor.
  int row = -1;
  Eigen::Vector3f place(0, -0.1F + 0.2F / 24, 0);
  for (int v = 0; v < stage.scene.vertex_offset(0, 1); ++v) {
    if ((stage.scene.vertices().row(v).transpose() - place).norm() < 1e-5F) {
      row = stage.transport.row_of_vertex[static_cast<std::size_t>(v)];
    }
  }
  ASSERT_GE(row, 0);
  const Eigen::VectorXf gathered = stage.transport.bounce * Eigen::VectorXf::Ones(stage.transport.bounce.cols());
  // View factor from a small piece of wall at height h to a perpendicular strip of floor of depth d, infinitely long:
  // (1 - h / sqrt(h^2 + d^2)) / 2; the floor is 0.2 m wide, 24 h, which leaves out less than 0.5 %.
  const float h = 0.2F / 24;
  const float d = 0.2F;
  const float expected = 0.5F * (1 - h / std::sqrt(h * h + d * d));
  // Floor seen at a cell's accuracy: its edge is some 50 cells long, known in quarters.
  EXPECT_NEAR(gathered(row), expected, 0.03F * expected);
  const Eigen::VectorXf direct = stage.transport.diffuse.row_sums();
  EXPECT_NEAR(direct(row), 1 - expected, 0.03F * expected);
}

TEST(Bounce, CarriesTheColourOfTheFloor) {
  const Stage stage = corner(32, 8);
  const FragmentLight out = light_up(stage, even_light(stage, 1.0F));
  Eigen::MatrixX3f albedo = Eigen::MatrixX3f::Zero(stage.transport.diffuse.rows(), 3);
  for (int v = stage.scene.vertex_offset(0, 1); v < stage.scene.vertex_count(); ++v) {
    const int row = stage.transport.row_of_vertex[static_cast<std::size_t>(v)];
    if (row >= 0) albedo.row(row) << 0.8F, 0, 0;
  }
  const Eigen::MatrixX3f bounced = bounced_shading(stage.transport, stage.view, out.vertex_shading, albedo);
  float wall_sum = 0;
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    EXPECT_EQ(bounced(i, 1), 0);
    if (stage.view.fragments.part[static_cast<std::size_t>(i)] == 0) {
      wall_sum += bounced(i, 0);
    } else {
      EXPECT_LE(bounced(i, 0), 1e-6F);  // the wall is black, and a floor does not light itself
    }
  }
  EXPECT_GT(wall_sum, 10);
}

TEST(Bounce, CanBeLeftOut) { EXPECT_EQ(corner(0, 4).transport.bounce.nonZeros(), 0); }

TEST(Bounce, VerticesThatNobodySeesAreStoodInFor) {
  // Rows for every second column of the floor only: what their neighbours send is counted for them.
  const Scene scene = scene_of({wall(0.1F, 24, 0), floor_of(0.1F, 24)});
  std::vector<int> all, some;
  for (int v = 0; v < scene.vertex_count(); ++v) {
    all.push_back(v);
    if (v < scene.vertex_offset(0, 1) || v % 2 == 0) some.push_back(v);
  }
  const SceneTransport with_all = build_scene_transport(scene, all, {.nside = 8});
  const SceneTransport with_some = build_scene_transport(scene, some, {.nside = 8});
  const float sum_all = (with_all.bounce * Eigen::VectorXf::Ones(with_all.bounce.cols())).head(600).sum();
  const float sum_some = (with_some.bounce * Eigen::VectorXf::Ones(with_some.bounce.cols())).head(600).sum();
  EXPECT_NEAR(sum_some, sum_all, 1e-3F * sum_all);
}

}  // namespace
}  // namespace faceprobe::synth

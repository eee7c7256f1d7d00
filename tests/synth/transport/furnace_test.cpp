// A white sky all around: nothing can come out brighter than it, and a white convex body exactly as bright.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/core/vertex_normals.h"
#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

// A ball with a deep dent: concave, as a face is around nose and chin.
SurfaceMesh dented_ball() {
  SurfaceMesh mesh = ball(0.1F, 60);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const float away = (mesh.normals.row(v) - Eigen::RowVector3f(0.3F, 0, 1).normalized()).squaredNorm();
    mesh.vertices.row(v) *= 1 - 0.55F * std::exp(-away / 0.08F);
  }
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  return mesh;
}

TEST(Furnace, WhiteConvexBodyVanishes) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 48));
  const FragmentLight light = light_up(stage, even_light(stage, 2.0F));
  // The acceptance is 0.5 %; rows are scaled to sum to 1, so that only the rounding of some 1,500 additions is left.
  EXPECT_NEAR(light.shading.minCoeff(), 2, 1e-4F);
  EXPECT_NEAR(light.shading.maxCoeff(), 2, 1e-4F);
  EXPECT_NEAR(light.vertex_shading.minCoeff(), 2, 1e-4F);
}

TEST(Furnace, ConcaveBodyIsDarkerAndTheBounceNeverBrightensItPastTheSky) {
  const Stage stage = make_stage(scene_of({dented_ball()}), camera_at(1.0F, 0.12F, 48));
  const FragmentLight light = light_up(stage, even_light(stage, 1.0F));
  EXPECT_LE(light.shading.maxCoeff(), 1.0001F);
  EXPECT_LT(light.shading.minCoeff(), 0.7F);
  const Eigen::MatrixX3f white = Eigen::MatrixX3f::Ones(stage.transport.diffuse.rows(), 3);
  const Eigen::MatrixX3f bounced = bounced_shading(stage.transport, stage.view, light.vertex_shading, white);
  const Eigen::MatrixX3f together = light.shading + bounced;
  EXPECT_LE(together.maxCoeff(), 1.0001F);
  // What the sky does not give, the other side of the dent gives in part.
  Eigen::Index darkest = 0;
  light.shading.col(0).minCoeff(&darkest);
  EXPECT_GT(together(darkest, 0), light.shading(darkest, 0) + 0.1F);
}

TEST(Furnace, SphericalCupIsLitByItsOpening) {
  // Inside a sphere every point sees every other part of it with the same share of its cosine-weighted sky, so a cup that is a
  // sphere but for a cap of height h gets h / (2 r) of the sky's light, anywhere.
  SurfaceMesh cup = inverted(ball(0.1F, 60));
  const float rim = 0.06F;  // z
  std::vector<int> kept;
  for (int t = 0; t < cup.triangles.rows(); ++t) {
    const Eigen::RowVector3i corners = cup.triangles.row(t);
    if ((cup.vertices(corners(0), 2) + cup.vertices(corners(1), 2) + cup.vertices(corners(2), 2)) / 3 < rim)
      kept.push_back(t);
  }
  cup.triangles = Eigen::MatrixX3i(cup.triangles(kept, Eigen::all));
  const Stage stage = make_stage(scene_of({cup}), camera_at(1.0F, 0.05F, 32));
  const FragmentLight light = light_up(stage, even_light(stage, 1.0F));
  const float expected = (0.1F - rim) / 0.2F;
  // The rim is jagged by half a triangle, 2.6 mm of 40 mm height at most and a third of that on average; the cells on the edge, some
  // 50 of 200 seen, are known in quarters.
  EXPECT_NEAR(light.shading.col(1).mean(), expected, 0.03F * expected);
  EXPECT_LT(light.shading.maxCoeff() - light.shading.minCoeff(), 0.15F * expected);
  // With rows for all of the cup the bounce fills up exactly what is missing, but for hits outside the last ring of triangles.
  std::vector<int> all(static_cast<std::size_t>(stage.scene.vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  const SceneTransport whole = build_scene_transport(stage.scene, all, {.nside = 8, .bounce_rays = 32});
  const Eigen::VectorXf bounced = whole.bounce * Eigen::VectorXf::Ones(whole.bounce.cols());
  const Eigen::VectorXf direct = whole.diffuse.row_sums();
  int inside = 0;
  for (Eigen::Index v = 0; v < bounced.size(); ++v) {
    if (stage.scene.vertices()(v, 2) > 0) continue;
    EXPECT_NEAR(bounced(v) + direct(v), 1, 1e-4F);
    ++inside;
  }
  EXPECT_GT(inside, 3000);
}

TEST(Furnace, OneCellLightsByItsCosine) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 48));
  const SphereGrid grid(16);
  const int cell = grid.cell_of({0.5F, 0.3F, 0.8F});
  LightSample light = even_light(stage, 0);
  light.cells.row(cell) << 10, 5, 1;
  const FragmentLight out = light_up(stage, light);
  const Fragments& seen = stage.view.fragments;
  for (int i = 0; i < seen.count(); ++i) {
    Eigen::RowVector3f normal = Eigen::RowVector3f::Zero();
    for (int k = seen.mix_first[static_cast<std::size_t>(i)]; k < seen.mix_first[static_cast<std::size_t>(i) + 1]; ++k) {
      const auto m = static_cast<std::size_t>(k);
      normal += seen.mix_weight[m] * stage.scene.normals().row(seen.mix_vertex[m]);
    }
    const float cosine = normal.dot(grid.direction(cell).transpose());
    if (std::abs(cosine) < 0.15F) continue;  // the cell sets, part by part
    const float expected = std::max(0.0F, cosine) * static_cast<float>(grid.cell_solid_angle() / kPi);
    // The mean direction of a cell is as good as its centre to its width squared, 0.065^2 / 12.
    EXPECT_NEAR(out.shading(i, 0), 10 * expected, 1e-3F * 10 * static_cast<float>(grid.cell_solid_angle() / kPi));
    EXPECT_NEAR(out.shading(i, 2) * 10, out.shading(i, 0), 1e-5F);
  }
}

TEST(Furnace, RedAtTheRightLightsTheRight) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 48));
  LightSample light = even_light(stage, 0.1F);
  const SphereGrid grid(16);
  light.cells.row(grid.cell_of({1, 0, 0})) << 100, 0, 0;
  const FragmentLight out = light_up(stage, light);
  for (const Eigen::MatrixX3f* layer : {&out.shading, &out.specular}) {
    float right = 0;
    float left = 0;
    for (int i = 0; i < stage.view.fragments.count(); ++i) {
      const bool is_right = stage.view.fragments.pixel[static_cast<std::size_t>(i)] % 48 >= 24;
      (is_right ? right : left) += (*layer)(i, 0) - (*layer)(i, 1);
    }
    EXPECT_GT(right, 20 * std::abs(left));
  }
}

TEST(Furnace, ResultsDoNotDependOnThreads) {
  const PinholeCamera camera = camera_at(1.0F, 0.12F, 40);
  const auto run = [&](int threads) {
    const Stage stage = make_stage(scene_of({dented_ball()}), camera, 0.3F, {.nside = 8, .threads = threads});
    std::vector<LightSample> lights(70, even_light(stage, 1.0F));  // more than one product takes at once
    for (std::size_t s = 0; s < lights.size(); ++s) {
      lights[s].cells.row(static_cast<Eigen::Index>(10 * s)) *= 9;
      lights[s].distant.push_back({Eigen::Vector3f(0.3F, 0.01F * static_cast<float>(s), 1).normalized(), {3, 2, 1}});
      lights[s].near.push_back({{0.1F, 0.2F, 0.3F}, 0.02F, {1, 1, 1}});
    }
    const std::vector<FragmentLight> out = shade(stage.scene, stage.transport, stage.view, lights, {.threads = threads});
    Eigen::MatrixX3f bounced =
        bounced_shading(stage.transport, stage.view, out[69].vertex_shading, out[69].vertex_shading);
    return std::tuple{out, bounced};
  };
  const auto [one, one_bounced] = run(1);
  const auto [three, three_bounced] = run(3);
  EXPECT_EQ(one_bounced, three_bounced);
  for (std::size_t s = 0; s < one.size(); ++s) {
    EXPECT_EQ(one[s].shading, three[s].shading);
    EXPECT_EQ(one[s].specular, three[s].specular);
    EXPECT_EQ(one[s].vertex_shading, three[s].vertex_shading);
  }
}

TEST(Furnace, RefusesWhatDoesNotFit) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 10)}), camera_at(1.0F, 0.12F, 16), 0.3F, {.nside = 4});
  LightSample wrong;
  wrong.cells.setZero(12, 3);
  EXPECT_THROW(light_up(stage, wrong), std::invalid_argument);
  EXPECT_THROW(build_scene_transport(stage.scene, {100000}, {}), std::invalid_argument);
  const SceneTransport nothing = build_scene_transport(stage.scene, {}, {.nside = 4});
  EXPECT_THROW(build_view_transport(stage.scene, nothing, stage.view.fragments, stage.view.surface, {0, 0, 1}, {}),
               std::invalid_argument);
  FragmentSurface short_one = stage.view.surface;
  short_one.f0.conservativeResize(3);
  EXPECT_THROW(build_view_transport(stage.scene, stage.transport, stage.view.fragments, short_one, {0, 0, 1}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::synth

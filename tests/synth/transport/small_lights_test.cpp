#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/sphere_grid.h"
#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::synth {
namespace {

const TransportOptions kCoarse{.nside = 4, .bounce_rays = 0};  // cells are dark in most of these tests

LightSample distant_light(const Stage& stage, const Eigen::Vector3f& towards, const Eigen::Vector3f& irradiance) {
  LightSample light = even_light(stage, 0);
  light.distant.push_back({towards.normalized(), irradiance});
  return light;
}

LightSample lamp(const Stage& stage, const Eigen::Vector3f& position, float radius, float radiance) {
  LightSample light = even_light(stage, 0);
  light.near.push_back({position, radius, Eigen::Vector3f::Constant(radiance)});
  return light;
}

TEST(SmallLights, DistantLightOnABallIsTheClosedForm) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 64), 0.3F, kCoarse);
  const Eigen::Vector3f towards = Eigen::Vector3f(0.7F, 0.4F, 0.5F).normalized();
  const FragmentLight out = light_up(stage, distant_light(stage, towards, {4, 2, 1}));
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    const Eigen::Vector3f normal = stage.view.fragments.normal.row(i).transpose();
    const Eigen::Vector3f view =
        (Eigen::Vector3f(0, 0, 1) - stage.view.fragments.position.row(i).transpose()).normalized();
    // Exact everywhere, the terminator too: no facet shades itself.
    EXPECT_NEAR(out.shading(i, 0), 4 * std::max(0.0F, normal.dot(towards)) / static_cast<float>(kPi), 1e-5F);
    const float lobe = specular_lobe(normal, view, towards, {stage.view.surface.roughness(i), 1.0F, 0.04F});
    EXPECT_NEAR(out.specular(i, 1), 2 * lobe, 1e-3F * lobe + 1e-5F);
  }
}

// No points on a lamp would leave it out in silence.
TEST(SmallLights, LampsWithoutPointsAreRefused) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 8)}), camera_at(1.0F, 0.12F, 8), 0.3F, kCoarse);
  EXPECT_THROW(light_up(stage, lamp(stage, {0, 0, 0.5F}, 0.02F, 1), {.near_light_samples = 0}), std::invalid_argument);
}

TEST(SmallLights, VerticesGetDistantLightForTheBounce) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 32), 0.3F, kCoarse);
  const Eigen::Vector3f towards = Eigen::Vector3f(-0.3F, 0.4F, 0.5F).normalized();
  const FragmentLight out = light_up(stage, distant_light(stage, towards, {3, 3, 3}));
  for (std::size_t v = 0; v < stage.transport.row_of_vertex.size(); ++v) {
    const int row = stage.transport.row_of_vertex[v];
    if (row < 0) continue;
    const float cosine = stage.scene.normals().row(static_cast<Eigen::Index>(v)).dot(towards.transpose());
    EXPECT_NEAR(out.vertex_shading(row, 2), 3 * std::max(0.0F, cosine) / static_cast<float>(kPi), 1e-5F);
  }
}

TEST(SmallLights, ShadowFallsWhereGeometrySays) {
  // A ball 0.1 m before a wall; light from 45 degrees above: the shadow is an ellipse around (0, -0.1).
  const Stage stage = make_stage(scene_of({wall(0.3F, 20, 0), ball(0.03F, 60, {0, 0, 0.1F})}),
                                 camera_at(2.0F, 0.25F, 128), 0.3F, kCoarse);
  const Eigen::Vector3f towards = Eigen::Vector3f(0, 1, 1).normalized();
  const FragmentLight out = light_up(stage, distant_light(stage, towards, {1, 1, 1}));
  int dark = 0;
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    const Eigen::Vector3f position = stage.view.fragments.position.row(i).transpose();
    const auto k = static_cast<std::size_t>(i);
    if (stage.view.fragments.part[k] != 0 || stage.view.fragments.coverage[k] < 1) continue;
    // Distance of the wall's point from the line through the ball's centre along the light.
    const float away = (position - Eigen::Vector3f(0, 0, 0.1F)).cross(towards).norm();
    if (std::abs(away - 0.03F) < 0.005F) continue;  // a pixel is 4 mm
    const float expected = away < 0.03F ? 0.0F : std::sqrt(0.5F) / static_cast<float>(kPi);
    EXPECT_NEAR(out.shading(i, 0), expected, 1e-5F) << position.transpose();
    dark += away < 0.03F ? 1 : 0;
  }
  EXPECT_GT(dark, 100);
}

TEST(SmallLights, ShadowsHaveSmoothEdges) {
  // A ball's shadow on a wall is an ellipse of pi r^2 / cos; pixels on its rim get their share of it.
  const float radius = 0.02F;
  const Stage stage = make_stage(scene_of({wall(0.13F, 80, 0), ball(radius, 60, {0, 0, 0.1F})}),
                                 camera_at(2.0F, 0.12F, 60), 0.3F, kCoarse);
  const Eigen::Vector3f towards = Eigen::Vector3f(0.8F, 0.1F, 1).normalized();
  const FragmentLight out = light_up(stage, distant_light(stage, towards, {1, 1, 1}));
  const float full = towards.z() / static_cast<float>(kPi);
  double dark_px = 0;
  int partly = 0;
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (stage.view.fragments.part[k] != 0 || stage.view.fragments.position(i, 0) > -0.04F) continue;
    const float dark = 1 - out.shading(i, 0) / full;
    partly += dark > 0.1F && dark < 0.9F ? 1 : 0;
    dark_px += static_cast<double>(dark * stage.view.fragments.coverage[k]);
  }
  // Some 40 pixels on the rim, each known to a fifth.
  EXPECT_GT(partly, 15);
  const double pixel_m = 0.24 / 60;
  EXPECT_NEAR(dark_px, kPi * radius * radius / static_cast<double>(towards.z()) / (pixel_m * pixel_m), 2.0);
}

TEST(SmallLights, CellsThrowTheSameShadowAsADistantLight) {
  const Stage stage =
      make_stage(scene_of({wall(0.3F, 40, 0), ball(0.04F, 60, {0, 0, 0.1F})}), camera_at(2.0F, 0.25F, 64));
  const SphereGrid grid(16);
  const int cell = grid.cell_of({0, 1, 1});
  LightSample light = even_light(stage, 0);
  light.cells.row(cell).setOnes();
  const auto solid_angle = static_cast<float>(grid.cell_solid_angle());
  const FragmentLight from_cell = light_up(stage, light);
  const FragmentLight from_point =
      light_up(stage, distant_light(stage, grid.direction(cell), Eigen::Vector3f::Constant(solid_angle)));
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    const Eigen::Vector3f position = stage.view.fragments.position.row(i).transpose();
    if (stage.view.fragments.part[static_cast<std::size_t>(i)] != 0) continue;
    const float away = (position - Eigen::Vector3f(0, 0, 0.1F)).cross(grid.direction(cell)).norm();
    // The edge is as soft as the cell is wide (9 mm at this distance) and the wall's vertices are apart (15 mm).
    if (std::abs(away - 0.04F) < 0.025F) continue;
    EXPECT_NEAR(from_cell.shading(i, 0), from_point.shading(i, 0), 1e-3F * solid_angle);
  }
}

TEST(SmallLights, LampFollowsTheInverseSquare) {
  const Stage stage = make_stage(scene_of({wall(0.05F, 4, 0)}), camera_at(1.0F, 0.04F, 16), 0.3F, kCoarse);
  const int middle = fragment_at(stage, {0, 0, 0});
  const Eigen::Vector3f place = stage.view.fragments.position.row(middle).transpose();
  for (const float distance : {0.3F, 0.6F, 1.2F}) {
    const float radius = 0.05F;
    const FragmentLight out = light_up(stage, lamp(stage, place + Eigen::Vector3f(0, 0, distance), radius, 2.0F));
    // Irradiance of a sphere straight above is pi L r^2 / d^2 at any distance; shading is that over pi. Rays start 0.1 mm nearer,
    // and 16 points on the lamp know the mean cosine to r^4 / d^4 / 8.
    const float expected = 2.0F * radius * radius / (distance * distance);
    EXPECT_NEAR(out.shading(middle, 0), expected, 2e-3F * expected);
  }
}

TEST(SmallLights, FarLampIsADistantLight) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 40)}), camera_at(1.0F, 0.12F, 32), 0.3F, kCoarse);
  const Eigen::Vector3f towards = Eigen::Vector3f(0.5F, 0.5F, 0.7F).normalized();
  const float distance = 100;
  const float radius = 1;
  const float irradiance = static_cast<float>(kPi) * radius * radius / (distance * distance);
  const FragmentLight near_one = light_up(stage, lamp(stage, distance * towards, radius, 1.0F));
  const FragmentLight far_one = light_up(stage, distant_light(stage, towards, Eigen::Vector3f::Constant(irradiance)));
  // The lamp is 1 degree wide and its direction differs by 0.1 m / 100 m over the ball.
  EXPECT_LE((near_one.shading - far_one.shading).cwiseAbs().maxCoeff(), 0.01F * irradiance);
  EXPECT_LE((near_one.vertex_shading - far_one.vertex_shading).cwiseAbs().maxCoeff(), 0.01F * irradiance);
  EXPECT_LE((near_one.specular - far_one.specular).cwiseAbs().maxCoeff(), 0.02F * far_one.specular.maxCoeff());
}

TEST(SmallLights, LampBehindTheBlockIsHiddenAndBeforeItIsNot) {
  const Stage stage = make_stage(scene_of({wall(0.05F, 4, 0), inverted(wall(0.05F, 2, 0.5F))}),
                                 camera_at(0.4F, 0.04F, 16), 0.3F, kCoarse);
  const int middle = fragment_at(stage, {0, 0, 0});
  EXPECT_EQ(light_up(stage, lamp(stage, {0, 0, 0.7F}, 0.02F, 1)).shading(middle, 0), 0);
  EXPECT_GT(light_up(stage, lamp(stage, {0, 0, 0.3F}, 0.02F, 1)).shading(middle, 0), 0);
}

}  // namespace
}  // namespace faceprobe::synth

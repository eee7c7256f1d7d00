#include "synth/transport/hair.h"

#include "faceprobe/core/sphere_grid.h"
#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

Strands upright_hairs(int count, float spacing, float radius) {
  Strands hair;
  hair.points.resize(2 * count, 4);
  hair.first_point = {0};
  for (int i = 0; i < count; ++i) {
    const float x = spacing * (static_cast<float>(i) - 0.5F * static_cast<float>(count - 1));
    hair.points.row(2 * i) << x, -0.1F, 0, radius;
    hair.points.row(2 * i + 1) << x, 0.1F, 0, radius;
    hair.first_point.push_back(2 * i + 2);
    hair.tone.push_back(1);
  }
  return hair;
}

TEST(Hair, WhiteStrandUnderAWhiteSkyIsWhite) {
  const SphereGrid grid(32);
  for (const double angle : {90.0, 60.0, 30.0}) {
    const Eigen::Vector3f view = Eigen::Vector3d(std::sin(radians(angle)), std::cos(radians(angle)), 0).cast<float>();
    Eigen::ArrayXf diffuse;
    Eigen::ArrayXf specular;
    hair_values(make_strand({0, 1, 0}, view, 0.3F, 1.0F), grid.directions(), diffuse, specular);
    const auto solid_angle = static_cast<float>(grid.cell_solid_angle());
    EXPECT_NEAR(diffuse.sum() * solid_angle, 1, 0.005F) << angle;
    EXPECT_NEAR(0.25F * specular.sum() * solid_angle, 1, 0.01F) << angle;
  }
}

TEST(Hair, LobeLiesOnTheMirrorsCone) {
  const Eigen::Vector3f view = Eigen::Vector3f(1, 0.5F, 0).normalized();
  const Strand strand = make_strand({0, 1, 0}, view, 0.2F, 0.05F);
  Eigen::MatrixX3f lights(2, 3);
  lights.row(0) = Eigen::RowVector3f(1, -0.5F, 0).normalized();
  lights.row(1) = Eigen::RowVector3f(1, 0.5F, 0).normalized();
  Eigen::ArrayXf diffuse;
  Eigen::ArrayXf specular;
  hair_values(strand, lights, diffuse, specular);
  EXPECT_NEAR(diffuse(0), diffuse(1), 1e-6F);
  EXPECT_GT(specular(0), 20 * specular(1));
}

TEST(Hair, FragmentsRunAlongTheStrand) {
  const Stage stage =
      make_stage(scene_of({}, {upright_hairs(1, 0, 0.005F)}), camera_at(1.0F, 0.12F, 48), 0.3F, {.nside = 4});
  ASSERT_GT(stage.view.hair.size(), 40U);
  EXPECT_EQ(static_cast<int>(stage.view.hair.size()), stage.view.fragments.count());
  for (const int i : stage.view.hair) {
    EXPECT_EQ(stage.view.fragments.vertex(i, 0), -1);
    EXPECT_EQ(stage.view.fragments.material[static_cast<std::size_t>(i)], Material::kHair);
    EXPECT_NEAR(std::abs(stage.view.fragments.tangent(i, 1)), 1, 1e-5F);
    EXPECT_NEAR(stage.view.fragments.normal.row(i).dot(stage.view.fragments.tangent.row(i)), 0, 1e-4F);
  }
}

TEST(Hair, LoneStrandSeesTheWholeSky) {
  const Stage stage = make_stage(scene_of({}, {upright_hairs(1, 0, 0.002F)}), camera_at(1.0F, 0.12F, 48));
  const FragmentLight out = light_up(stage, even_light(stage, 1.0F));
  // Rays start outside the strand's own thickness; only those along it are blocked, and sin(T, L) is small for them.
  EXPECT_NEAR(out.shading.mean(), 1, 0.01F);
  EXPECT_LE(out.shading.maxCoeff(), 1.005F);  // cells know the integral to that
}

TEST(Hair, DistantLightIsTheClosedFormAndABallBlocksIt) {
  const Eigen::Vector3f towards = Eigen::Vector3f(0.6F, 0.3F, 0.9F).normalized();
  for (const bool blocked : {false, true}) {
    std::vector<SurfaceMesh> meshes;
    if (blocked) meshes.push_back(ball(0.2F, 30, 0.7F * towards));
    PinholeCamera camera = camera_at(1.0F, 0.12F, 48);
    camera.camera_from_scene.translation().x() = 0;
    camera.camera_from_scene.linear() = Eigen::AngleAxisf(1.2F, Eigen::Vector3f::UnitY()).toRotationMatrix();
    const Stage stage = make_stage(scene_of(meshes, {upright_hairs(1, 0, 0.003F)}), camera);
    LightSample light = even_light(stage, 0);
    light.distant.push_back({towards, {2, 2, 2}});
    const FragmentLight out = light_up(stage, light);
    const float sine = std::sqrt(1 - towards.y() * towards.y());
    const float expected = blocked ? 0.0F : 2 * sine / static_cast<float>(kPi * kPi);
    ASSERT_GT(stage.view.hair.size(), 20U);
    for (const int i : stage.view.hair) EXPECT_NEAR(out.shading(i, 0), expected, 1e-5F);
  }
}

TEST(Hair, DoesNotDependOnThreads) {
  const auto run = [](int threads) {
    const Stage stage = make_stage(scene_of({ball(0.05F, 20)}, {upright_hairs(30, 0.006F, 0.001F)}),
                                   camera_at(1.0F, 0.12F, 32), 0.3F, {.nside = 4, .threads = threads});
    LightSample light = even_light(stage, 1);
    light.distant.push_back({Eigen::Vector3f(0.3F, 0.3F, 1).normalized(), {2, 2, 2}});
    light.near.push_back({{0.1F, 0.2F, 0.3F}, 0.02F, {1, 1, 1}});
    return light_up(stage, light, {.threads = threads});
  };
  const FragmentLight one = run(1);
  const FragmentLight three = run(3);
  EXPECT_EQ(one.shading, three.shading);
  EXPECT_EQ(one.specular, three.specular);
  EXPECT_GT(one.specular.minCoeff(), 0);
}

TEST(Hair, ThrowsAShadow) {
  const Scene scene = scene_of({wall(0.3F, 20, -0.1F)}, {upright_hairs(40, 0.004F, 0.002F)});  // a closed curtain
  EXPECT_TRUE(scene.occluded({0.01F, 0, -0.099F}, {0, 0, 1}));
  EXPECT_FALSE(scene.occluded({0.2F, 0, -0.099F}, {0, 0, 1}));
}

}  // namespace
}  // namespace faceprobe::synth

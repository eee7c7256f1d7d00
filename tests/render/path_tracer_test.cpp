#include "faceprobe/render/path_tracer.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::render {
namespace {

constexpr PinholeView kView{80, 32, 32, 64, 64};

// A ball of radius .15 m, a metre away.
Model ball(const Material& material) {
  Model model = sphere();
  model.materials = {material};
  for (TriangleMesh& mesh : model.meshes) mesh.material = 0;
  place(model, {.height_m = 0.3F, .foot_m = {0, -0.15F, -1}});
  return model;
}

EnvMap even_map(float value) {
  EnvMap map(16, 8);
  for (float& v : map.radiance().values()) v = value;
  return map;
}

// A red light of 3 degrees near `direction`, which becomes the right one.
EnvMap one_light(Eigen::Vector3f& direction) {
  EnvMap map(128, 64);
  const Eigen::Vector2f uv = uv_from_direction(direction);
  const int x = static_cast<int>(uv.x() * 128);
  const int y = static_cast<int>(uv.y() * 64);
  map.radiance()(x, y, 0) = 1000;
  direction = map.direction(x, y);
  return map;
}

Eigen::Vector3f light_of(const Image& object, int x, int y) {
  return Eigen::Map<const Eigen::Vector3f>(object.pixel(x, y)) / object(x, y, 3);
}

TEST(PathTracer, WhiteFurnace) {
  const Eigen::Vector3f white = Eigen::Vector3f::Ones();
  const std::vector<Material> materials = {
      {.name = "diffuse", .kind = MaterialKind::kDiffuse, .colour = white},
      {.name = "mirror", .kind = MaterialKind::kMetal, .colour = white},
      {.name = "rough metal", .kind = MaterialKind::kMetal, .colour = white, .roughness = 0.6F},
      {.name = "plastic", .kind = MaterialKind::kPlastic, .colour = white},
      {.name = "rough plastic", .kind = MaterialKind::kPlastic, .colour = white, .roughness = 0.5F},
      {.name = "glass", .kind = MaterialKind::kGlass, .colour = white}};
  for (const Material& material : materials) {
    const PathTracer tracer(ball(material), even_map(0.7F), {.view = kView});
    const Layers layers = tracer.render({.samples = 256, .least_samples = 256, .max_bounces = 64});
    double sum = 0;
    double coverage = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        sum += layers.object(x, y, 1);
        coverage += layers.object(x, y, 3);
      }
    }
    EXPECT_NEAR(sum / coverage, 0.7, 0.005 * 0.7) << material.name;
    EXPECT_NEAR(light_of(layers.object, 32, 32).x(), 0.7F, 0.02F * 0.7F) << material.name;  // noise of one pixel
  }
}

TEST(PathTracer, AChangedColourIsSeen) {
  const Material red = changed(material_preset("diffuse"), {.colour = colour_from("#ff0000")});
  const Layers layers = PathTracer(ball(red), even_map(1), {.view = kView}).render({.samples = 64});
  EXPECT_NEAR(light_of(layers.object, 32, 32).x(), 1, 0.02);  // noise of one pixel
  EXPECT_EQ(light_of(layers.object, 32, 32).y(), 0);
  EXPECT_EQ(light_of(layers.object, 32, 32).z(), 0);
}

TEST(PathTracer, AChangedRoughnessWidensTheHighlight) {
  Eigen::Vector3f towards = Eigen::Vector3f(0.3F, 0.4F, 0.8F).normalized();
  const EnvMap map = one_light(towards);
  const auto peak = [&](float roughness) {
    const Material metal = changed(material_preset("silver"), {.roughness = roughness});
    const Layers layers = PathTracer(ball(metal), map, {.view = kView}).render({.samples = 256});
    float brightest = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) brightest = std::max(brightest, layers.object(x, y, 0));
    }
    return brightest;
  };
  // A lobe's peak falls with the fourth power of roughness, here by 1300; a pixel of 10 degrees of the mirrored room sees less of that.
  EXPECT_GT(peak(0.1F), 4 * peak(0.6F));
}

TEST(PathTracer, FurnaceWithGroundLosesWhatTheGroundTakes) {
  // Nothing is lost between a white ball and a white ground, which here goes on for ever.
  const Model model = ball({.colour = Eigen::Vector3f::Ones()});
  const Ground white{.point_m = {0, -0.15F, -1}, .radius_m = 1e4F, .albedo = Eigen::Vector3f::Ones()};
  const PathTracer tracer(model, even_map(1), {.view = kView, .ground = white});
  const Layers layers = tracer.render({.samples = 256, .max_bounces = 200});
  EXPECT_NEAR(light_of(layers.object, 32, 32).x(), 1, 0.02);
  EXPECT_NEAR(layers.shadow(32, 60), 1, 0.02);
  // A black one hides half of the sky from the ball's side: light falls by the half-cosine, (1 + n.up) / 2.
  Ground black = white;
  black.albedo.setZero();
  const Layers dark = PathTracer(model, even_map(1), {.view = kView, .ground = black}).render({.samples = 256});
  const Eigen::Vector3f normal = Eigen::Map<const Eigen::Vector3f>(dark.normal.pixel(32, 24));
  EXPECT_NEAR(light_of(dark.object, 32, 24).x(), (1 + normal.y()) / 2, 0.02);
}

TEST(PathTracer, BallLampFollowsTheInverseSquare) {
  // A ball that is wholly above a surface gives it I cos / r^2, however large it is: here to a card of .2 m that faces up.
  Model card;
  card.materials = {{.colour = Eigen::Vector3f::Ones()}};
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << -0.1F, -0.3F, -1.1F, 0.1F, -0.3F, -1.1F, 0.1F, -0.3F, -0.9F, -0.1F, -0.3F, -0.9F;
  mesh.normals = Eigen::RowVector3f::UnitY().replicate(4, 1);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 2, 1, 0, 3, 2;
  card.meshes = {mesh};
  const Eigen::Vector3f seen(0, -0.3F, -1);  // pixel (32, 32 + 80 * .3)
  for (const float radius : {0.01F, 0.3F}) {
    const BallLamp lamp{.position_m = {0.5F, 0.4F, -1.3F}, .radius_m = radius, .intensity = {1, 2, 3}};
    const PathTracer tracer(card, EnvMap(8, 4), {.view = {800, 32, 32 - 240, 64, 64}, .lamps = {lamp}});
    const Eigen::Vector3f way = lamp.position_m - seen;
    const float expected = way.normalized().y() / way.squaredNorm() / static_cast<float>(kPi);
    const Layers layers = tracer.render({.samples = 256});
    EXPECT_NEAR(light_of(layers.object, 32, 32).x(), expected, 0.01F * expected) << radius;  // noise; a pixel is 2 mm
    EXPECT_NEAR(light_of(layers.object, 32, 32).z(), 3 * expected, 0.03F * expected) << radius;
    EXPECT_NEAR(open_light(EnvMap(8, 4), {lamp}, seen, Eigen::Vector3f::UnitY()).x(), expected, 1e-5F * expected);
    // And beside a sky, which it does not hide.
    const PathTracer both(card, even_map(0.4F), {.view = {800, 32, 32 - 240, 64, 64}, .lamps = {lamp}});
    EXPECT_NEAR(light_of(both.render({.samples = 1024}).object, 32, 32).x(), expected + 0.4F, 0.01F * (expected + 0.4F));
  }
}

TEST(OpenLight, EvenSkyGivesItsRadiance) {
  for (const Eigen::Vector3f& normal : {Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0.6F, 0, 0.8F)})
    EXPECT_NEAR(open_light(even_map(0.6F), {}, {0, 0, 0}, normal).y(), 0.6F, 0.02F * 0.6F);  // 8 rows of texels
}

TEST(OpenLight, ALampAroundThePointGivesNothing) {
  const BallLamp around{.position_m = {0, 0.05F, 0}, .radius_m = 0.1F};
  for (const float y : {0.0F, 0.05F})  // in it, and at its centre, which has no direction
    EXPECT_EQ(open_light(EnvMap(8, 4), {around}, {0, y, 0}, Eigen::Vector3f::UnitY()), Eigen::Vector3f::Zero()) << y;
}

TEST(PinholeView, RaysGoRightAndUpWithThePhoto) {
  const PinholeView view{.focal_px = 200, .centre_x_px = 30, .centre_y_px = 20, .width_px = 64, .height_px = 48};
  EXPECT_EQ(view.ray(30, 20), Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(view.ray(130, 20), Eigen::Vector3f(0.5F, 0, -1));
  EXPECT_EQ(view.ray(30, -80), Eigen::Vector3f(0, 0.5F, -1));
}

TEST(PathTracer, LampIsSeenInAMirrorAsBrightAsItIs) {
  const BallLamp lamp{.position_m = {0, 0, 1.5F}, .radius_m = 0.8F, .intensity = Eigen::Vector3f::Ones()};
  const PathTracer tracer(ball({.kind = MaterialKind::kMetal, .colour = Eigen::Vector3f::Ones()}), even_map(0.1F),
                          {.view = kView, .lamps = {lamp}});
  const float radiance = 1 / (static_cast<float>(kPi) * 0.64F) + 0.1F;
  EXPECT_NEAR(light_of(tracer.render({.samples = 64}).object, 32, 32).x(), radiance, 1e-3F * radiance);
}

TEST(PathTracer, DiffuseBallUnderOneLight) {
  Eigen::Vector3f towards = Eigen::Vector3f(0.6F, 0.5F, 0.62F).normalized();
  const EnvMap map = one_light(towards);
  const Eigen::Vector3d integral = map.integral();
  const PathTracer tracer(ball({.colour = Eigen::Vector3f::Constant(0.5F)}), map, {.view = kView});
  const Layers layers = tracer.render({.samples = 256, .max_bounces = 1});
  for (const auto& [x, y] : std::vector<std::pair<int, int>>{{36, 28}, {40, 32}, {32, 26}}) {
    const Eigen::Vector3f normal = Eigen::Map<const Eigen::Vector3f>(layers.normal.pixel(x, y));
    const double expected = 0.5 / kPi * integral.x() * normal.dot(towards);
    EXPECT_NEAR(light_of(layers.object, x, y).x(), expected, 0.03 * expected);  // a pixel is 5 degrees wide
    EXPECT_EQ(layers.object(x, y, 1), 0);                                       // a red light
  }
  EXPECT_EQ(layers.object(24, 38, 0), 0);  // turned away from it
}

TEST(PathTracer, ShadowLiesOppositeTheLightAndNowhereElse) {
  Eigen::Vector3f towards = Eigen::Vector3f(1, 1, 0).normalized();
  const Ground ground{.point_m = {0, -0.3F, -1}, .radius_m = 3};
  const PathTracer tracer(ball({.colour = Eigen::Vector3f::Zero()}), one_light(towards),
                          {.view = {60, 32, 20, 64, 64}, .ground = ground});
  const Layers layers = tracer.render({.samples = 64});
  // The ball's centre, .3 above the ground, throws its shadow .3 to the left: pixel (32 - 60 * .3, 20 + 60 * .3).
  EXPECT_LT(layers.shadow(14, 38, 0), 1e-3F);
  EXPECT_EQ(layers.ground(14, 38), 1);
  EXPECT_EQ(layers.shadow(58, 45, 0), 1);  // exactly: the same draws with and without
  EXPECT_EQ(layers.ground(32, 2), 0);      // sky
  EXPECT_EQ(layers.shadow(32, 2, 0), 1);
}

TEST(PathTracer, FromBelowTheGroundIsNotThere) {
  const Ground ground{.point_m = {0, 0.2F, -1}, .radius_m = 3};
  const PathTracer tracer(ball(material_preset("diffuse")), even_map(1), {.view = kView, .ground = ground});
  const Layers layers = tracer.render({.samples = 16});
  EXPECT_EQ(layers.object(32, 32, 3), 1);
  EXPECT_EQ(layers.ground(32, 4), 0);
}

TEST(PathTracer, MirrorShowsThePhotoBehindTheViewOnlyWhereItIs) {
  Image photo(64, 64, 3);
  for (float& v : photo.values()) v = 0.25F;
  Material clear{.kind = MaterialKind::kGlass, .colour = Eigen::Vector3f::Ones(), .ior = 1.0F};  // bends nothing
  const PathTracer through(ball(clear), even_map(1), {.view = kView, .backdrop = Backdrop{kView, photo}});
  EXPECT_NEAR(light_of(through.render({.samples = 16}).object, 30, 33).x(), 0.25F, 1e-5F);
  const PathTracer mirror(ball({.kind = MaterialKind::kMetal, .colour = Eigen::Vector3f::Ones()}), even_map(1),
                          {.view = kView, .backdrop = Backdrop{kView, photo}});
  EXPECT_NEAR(light_of(mirror.render({.samples = 16}).object, 32, 32).x(), 1, 1e-5F);  // looks back, at the map
}

TEST(PathTracer, SameForAnyNumberOfThreads) {
  const Ground ground{.point_m = {0, -0.15F, -1}};
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  const PathTracer tracer(ball(material_preset("plastic")), one_light(up), {.view = kView, .ground = ground});
  const Layers one = tracer.render({.samples = 256, .noise = 0.05F, .threads = 1});
  const Layers three = tracer.render({.samples = 256, .noise = 0.05F, .threads = 3});
  EXPECT_NE(one.samples(32, 32), one.samples(2, 2));  // some squares stopped early
  EXPECT_EQ(one.object, three.object);
  EXPECT_EQ(one.shadow, three.shadow);
  EXPECT_EQ(one.samples, three.samples);
}

TEST(PathTracer, SamplesGoWhereTheNoiseIs) {
  // The ball's rim is 30 pixels from the middle.
  const PathTracer tracer(ball(material_preset("diffuse")), even_map(0.5F), {.view = {200, 32, 32, 64, 64}});
  const Layers layers = tracer.render({.samples = 1024, .noise = 0.01F});
  EXPECT_GT(layers.samples(0, 0), layers.samples(32, 32));
  EXPECT_LT(layers.samples(32, 32), 512);
  EXPECT_EQ(
      PathTracer(ball(material_preset("diffuse")), even_map(0.5F), {.view = kView}).render({.samples = 99}).samples(2, 2),
      16);
}

TEST(PathTracer, StopsWhenTold) {
  const PathTracer tracer(ball(material_preset("diffuse")), even_map(0.5F), {.view = kView});
  int calls = 0;
  RenderOptions options{.samples = 4};
  options.threads = 1;
  options.progress = [&](float share) {
    EXPECT_GT(share, 0);
    return ++calls < 3;
  };
  tracer.render(options);
  EXPECT_EQ(calls, 3);
}

TEST(PathTracer, RefusesWhatCannotBeDrawn) {
  const Model model = ball(material_preset("diffuse"));
  EXPECT_THROW(PathTracer(Model{}, even_map(1), {.view = kView}), std::invalid_argument);
  EXPECT_THROW(PathTracer(model, EnvMap(), {.view = kView}), std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(-1), {.view = kView}), std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(1), {}), std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(1), {.view = kView, .ground = Ground{.up = {0, 2, 0}}}),
               std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(1), {.view = kView, .lamps = {{.radius_m = 0}}}), std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(1), {.view = kView, .backdrop = Backdrop{kView, Image(3, 3, 3)}}),
               std::invalid_argument);
  EXPECT_THROW(PathTracer(model, even_map(1), {.view = kView}).render({.samples = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::render

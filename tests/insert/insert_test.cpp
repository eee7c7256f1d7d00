#include "faceprobe/insert/insert.h"

#include "faceprobe/core/error.h"
#include "faceprobe/insert/spot.h"
#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

namespace faceprobe::insert {
namespace {

constexpr render::PinholeView kView{120, 48, 36, 96, 72};

EnvMap even_map(float value) {
  EnvMap map(16, 8);
  for (float& v : map.radiance().values()) v = value;
  return map;
}

Scene ball_in(const EnvMap& map, const Eigen::Vector3f& foot = {0, -0.15F, -1}) {
  Scene scene{.view = kView, .environment = map, .model = render::sphere()};
  scene.model.materials = {render::material_preset("diffuse")};
  for (render::TriangleMesh& mesh : scene.model.meshes) mesh.material = 0;
  render::place(scene.model, {.height_m = 0.2F, .foot_m = foot});
  return scene;
}

Options plain(int samples) {
  Options options;
  options.render.samples = samples;
  options.render.noise = 0;
  options.match_blur = options.match_grain = false;
  return options;
}

TEST(Insert, PhotoStaysOutsideTheBox) {
  Image photo(96, 72, 3);
  for (std::size_t i = 0; i < photo.values().size(); ++i) photo.values()[i] = static_cast<float>(i % 97) / 97;
  Scene scene = ball_in(even_map(1), {0.2F, -0.1F, -1});
  scene.ground = false;
  const Insertion done = insert_model(photo, scene, plain(4));
  int same = 0;
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 96; ++x) {
      const bool inside = x >= done.box.left && x < done.box.right && y >= done.box.top && y < done.box.bottom;
      if (inside) continue;
      ++same;
      EXPECT_EQ(done.picture(x, y, 1), photo(x, y, 1));
    }
  }
  EXPECT_GT(same, 96 * 72 / 2);                       // the ball is 24 px wide
  EXPECT_NEAR(done.picture(72, 36, 0), 0.8F, 0.05F);  // albedo under an even sky of 1; noise of 4 draws
}

// A scene drawn whole, with its ground, and the same put together from the empty ground and the layers: differential rendering is exact
// where the photo is that ground.
TEST(Insert, OnAGroundOfKnownLightItIsTheSameAsDrawingAll) {
  EnvMap map = even_map(0.3F);
  map.radiance()(10, 2, 0) = map.radiance()(10, 2, 1) = map.radiance()(10, 2, 2) = 30;
  Scene scene = ball_in(map);
  const Eigen::Vector3f albedo(0.5F, 0.4F, 0.3F);
  scene.ground_albedo = albedo;
  const Eigen::Vector3f open = render::open_light(map, {}, {0, -0.15F, -1}, Eigen::Vector3f::UnitY());
  Image photo(96, 72, 3);
  for (std::size_t i = 0; i < photo.values().size(); ++i)
    photo.values()[i] = albedo[static_cast<Eigen::Index>(i % 3)] * open[static_cast<Eigen::Index>(i % 3)];
  const Insertion done = insert_model(photo, scene, plain(512));

  // The truth: the ground as a part of the model, a large card.
  render::Model whole = scene.model;
  render::TriangleMesh card;
  card.vertices.resize(4, 3);
  card.vertices << -9, -0.15F, -9, 9, -0.15F, -9, 9, -0.15F, -0.01F, -9, -0.15F, -0.01F;
  card.normals = Eigen::RowVector3f::UnitY().replicate(4, 1);
  card.triangles.resize(2, 3);
  card.triangles << 0, 2, 1, 0, 3, 2;
  card.material = 1;
  whole.meshes.push_back(card);
  whole.materials.push_back({.colour = albedo});
  const render::Layers truth = render::PathTracer(whole, map, {.view = kView}).render({.samples = 512});
  // Ball, shadow and open ground; noise of 512 draws, and the disc ends at .6 m where the card does not.
  for (const auto& [x, y] :
       std::vector<std::pair<int, int>>{{48, 38}, {44, 50}, {52, 50}, {30, 56}, {66, 56}, {48, 60}}) {
    for (int c = 0; c < 3; ++c) {
      const float expected = truth.object(x, y, c);
      EXPECT_NEAR(done.picture(x, y, c), expected, 0.05F * expected) << x << ' ' << y;
    }
  }
  EXPECT_LT(done.picture(44, 52, 0) + done.picture(52, 52, 0), 1.9F * photo(0, 0, 0));  // there is a shadow on one side
}

TEST(Insert, GroundTakesItsColourFromThePhoto) {
  const Image photo(96, 72, 3, 0.2F);
  const Insertion done = insert_model(photo, ball_in(even_map(0.5F)), plain(1));
  // .2 from a light of .5: albedo .4. The light is summed over 8 rows of texels.
  EXPECT_NEAR(done.ground_albedo.x(), 0.4F, 0.01F);
}

TEST(Insert, ThePersonInFrontIsKept) {
  const Image photo(96, 72, 3, 0.25F);
  Scene scene = ball_in(even_map(1));
  scene.matte = Matte{Image(96, 72, 1), Image(96, 72, 1, 0.5F)};
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 48; ++x) scene.matte->cover(x, y) = 1;
  }
  const Insertion done = insert_model(photo, scene, plain(4));
  EXPECT_EQ(done.picture(44, 40, 0), 0.25F);
  EXPECT_GT(done.picture(52, 40, 0), 0.5F);
}

TEST(Insert, NoRimOfTheHiddenModelIsLeftOnThePerson) {
  const Image photo(96, 72, 3, 0.25F);
  Scene scene = ball_in(even_map(1));
  scene.ground = false;
  scene.matte = Matte{Image(96, 72, 1, 1), Image(96, 72, 1, 0.5F)};
  Options options = plain(4);
  options.match_blur = true;
  const Insertion done = insert_model(photo, scene, options);
  EXPECT_GT(done.blur_px, 0);
  for (const float value : done.picture.values()) ASSERT_NEAR(value, 0.25F, 1e-6F);  // sums of floats
}

TEST(Insert, BlurTearsNoShadowFromItsFoot) {
  // A black ball and its shadow take as much light from the picture, blurred or not.
  EnvMap map = even_map(0.2F);
  map.radiance()(8, 1, 0) = map.radiance()(8, 1, 1) = map.radiance()(8, 1, 2) = 40;
  Image photo(96, 72, 3, 0.5F);
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 12; ++x) std::fill_n(photo.pixel(x, y), 3, 0.05F);  // an edge ...
  }
  photo = blur(photo, 2);  // ... that is soft
  Scene scene = ball_in(map);
  scene.model.materials[0].colour.setZero();
  scene.ground_albedo = Eigen::Vector3f::Zero();
  const auto sum = [&](bool soft) {
    Options options = plain(64);
    options.match_blur = soft;
    const Insertion done = insert_model(photo, scene, options);
    EXPECT_EQ(done.blur_px > 1, soft);
    double total = 0;
    for (std::size_t i = 0; i < photo.values().size(); ++i) total += photo.data()[i] - done.picture.data()[i];
    return total;
  };
  EXPECT_NEAR(sum(true), sum(false), 0.01 * sum(false));  // the soft edge of the photo under the blurred layers
}

TEST(Insert, ShadowOnASlantedGroundIsNotCutOff) {
  EnvMap map = even_map(0.05F);
  map.radiance()(3, 4, 1) = map.radiance()(4, 4, 1) = 30;  // from the side
  const Image photo(96, 72, 3, 0.5F);
  Scene scene = ball_in(map);
  scene.up = Eigen::Vector3f(0, 0.5F, 0.866F);  // a table seen from above
  const Insertion done = insert_model(photo, scene, plain(16));
  EXPECT_EQ(done.box.left,
            0);  // the disc, .6 m about a ball of .2 m at 1 m, is wider and higher than the view of 120 px focal length
  EXPECT_EQ(done.box.right, 96);
  EXPECT_EQ(done.box.top, 0);
  EXPECT_EQ(done.box.bottom, 72);
}

TEST(Insert, ShrinkKeepsWhatIsSeen) {
  Image photo(96, 72, 3, 0.5F);
  Scene scene = ball_in(even_map(1));
  scene.matte = Matte{Image(96, 72, 1, 1), Image(96, 72, 1, 2)};
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 31; ++x) scene.matte->cover(x, y) = scene.matte->depth_m(x, y) = 0;
  }
  const auto before = *box_in_view(scene.view, scene.model.box());
  shrink(photo, scene, 48);
  EXPECT_EQ(photo.width(), 48);
  EXPECT_EQ(photo.height(), 36);
  const auto after = *box_in_view(scene.view, scene.model.box());
  EXPECT_NEAR(after.left, 0.5 * before.left, 1);
  EXPECT_NEAR(after.bottom, 0.5 * before.bottom, 1);
  EXPECT_TRUE(scene.matte->cover.same_size(photo));
  for (const float depth : scene.matte->depth_m.values())
    EXPECT_TRUE(depth == 0 || depth == 2);  // no mean of someone and nobody
  insert_model(photo, scene, plain(1));     // all sizes fit
}

TEST(Insert, SaysWhatItCannotDo) {
  const Image photo(96, 72, 3);
  try {
    insert_model(photo, ball_in(even_map(1), {5, 0, -1}), plain(1));
    FAIL() << "an object outside the picture was drawn";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
  }
  EXPECT_THROW(insert_model(photo, ball_in(even_map(1), {0, 0, 1}), plain(1)), Error);  // behind the camera
  EXPECT_THROW(insert_model(Image(9, 9, 3), ball_in(even_map(1)), plain(1)), std::invalid_argument);
}

TEST(Spot, HorizonTellsUp) {
  EXPECT_NEAR((up_from_horizon(kView, 36) - Eigen::Vector3f::UnitY()).norm(), 0, 1e-6);
  // A horizon above the middle: the camera looks down, so that up leans towards the viewer.
  const Eigen::Vector3f up = up_from_horizon(kView, 16);
  EXPECT_NEAR(up.z() / up.y(), 20.0 / 120, 1e-6);
  // The ray through a pixel of the horizon is level.
  EXPECT_NEAR(up.dot(point_at(kView, 80, 16, 1)), 0, 1e-6);
}

TEST(Spot, HeadsAndCameraShareTheSay) {
  const auto tilted = [](double degrees) {
    const double angle = degrees * 3.14159265358979 / 180;
    return Eigen::Vector3f(static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)), 0);
  };
  const auto lean = [](const Eigen::Vector3f& up) { return std::atan2(up.x(), up.y()) * 180 / 3.14159265358979; };
  EXPECT_NEAR(lean(up_from_heads({})), 0, 1e-6);
  // Weights 1/64 and 1/144 a head: 20 degrees * 64 / (64 + 144 / n).
  EXPECT_NEAR(lean(up_from_heads({tilted(20)})), 20 * 64.0 / 208, 0.1);  // vectors are averaged, not angles
  EXPECT_NEAR(lean(up_from_heads(std::vector<Eigen::Vector3f>(6, tilted(20)))), 20 * 64.0 / 88, 0.1);
}

TEST(Spot, PointLiesOnItsRay) {
  const Eigen::Vector3f p = point_at(kView, 60, 30, 2);
  EXPECT_FLOAT_EQ(p.z(), -2);
  EXPECT_NEAR(48 + 120 * p.x() / 2, 60, 1e-4);
  EXPECT_NEAR(36 - 120 * p.y() / 2, 30, 1e-4);
}

}  // namespace
}  // namespace faceprobe::insert

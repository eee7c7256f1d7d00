// A map without any light, as the estimate of an all but black face may be.

#include "faceprobe/insert/insert.h"
#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace faceprobe::insert {
namespace {

Scene standing_in_the_dark(const std::string& shape) {
  Scene scene{.view = {120, 48, 36, 96, 72}, .environment = EnvMap(16, 8), .model = render::shape(shape)};
  render::place(scene.model, {.height_m = 0.2F, .foot_m = {0, -0.12F, -1}});
  return scene;
}

Options few_rays() {
  Options options;
  options.render.samples = 4;
  options.render.noise = 0;
  return options;
}

bool all_finite(const Image& image) {
  return std::ranges::all_of(image.values(), [](float v) { return std::isfinite(v); });
}

// The weights of the blur that layers get are floats, whose sum is 1 to within a few roundings.
constexpr float kRounding = 1e-6F;

// How many pixels of the box the object does not cover, and the largest change of the photo in them.
std::pair<int, float> change_beside(const Insertion& done, const Image& photo) {
  int count = 0;
  float change = 0;
  for (int y = 0; y < done.box.height(); ++y) {
    for (int x = 0; x < done.box.width(); ++x) {
      if (done.layers.object(x, y, 3) > 0) continue;
      ++count;
      const int photo_x = done.box.left + x;
      const int photo_y = done.box.top + y;
      for (int c = 0; c < 3; ++c)
        change = std::max(change, std::abs(done.picture(photo_x, photo_y, c) - photo(photo_x, photo_y, c)));
    }
  }
  return {count, change};
}

TEST(Dark, TheGroundKeepsThePhoto) {
  const Image photo(96, 72, 3, 0.25F);
  for (const char* shape : {"sphere", "cube", "robot"}) {
    const Insertion done = insert_model(photo, standing_in_the_dark(shape), few_rays());
    for (const Image* image : {&done.picture, &done.layers.object, &done.layers.shadow, &done.layers.ground,
                               &done.layers.depth, &done.layers.normal})
      EXPECT_TRUE(all_finite(*image)) << shape;
    EXPECT_TRUE(done.ground_albedo.allFinite()) << shape;
    const auto [count, change] = change_beside(done, photo);
    EXPECT_GT(count, 500) << shape;  // the box is three times as wide as the object
    EXPECT_LT(change, kRounding) << shape;
    EXPECT_GT(std::ranges::max(done.layers.ground.values()), 0.9F) << shape;  // there was ground to take a shadow
    for (const float shadow : done.layers.shadow.values()) ASSERT_NEAR(shadow, 1, kRounding) << shape;
  }
}

TEST(Dark, TheObjectIsBlack) {
  const Image photo(96, 72, 3, 0.25F);
  Scene scene = standing_in_the_dark("cube");
  // Diffuse, so that nothing of the photo is mirrored in it.
  scene.model.materials = {render::material_preset("diffuse")};
  for (render::TriangleMesh& mesh : scene.model.meshes) mesh.material = 0;
  const Insertion done = insert_model(photo, scene, few_rays());
  EXPECT_NEAR(done.layers.object(48 - done.box.left, 42 - done.box.top, 3), 1, kRounding);
  EXPECT_NEAR(done.picture(48, 42, 0), 0, kRounding);
}

TEST(Dark, ABlackPhotoStaysBlack) {
  const Image photo(96, 72, 3);
  for (const bool ground : {true, false}) {
    Scene scene = standing_in_the_dark("pot");
    scene.ground = ground;
    const Insertion done = insert_model(photo, scene, few_rays());
    EXPECT_TRUE(std::ranges::all_of(done.picture.values(), [](float v) { return v == 0; })) << ground;
  }
}

TEST(Dark, ALampAloneLightsTheObject) {
  const Image photo(96, 72, 3, 0.25F);
  Scene scene = standing_in_the_dark("cube");
  scene.lamps.push_back(
      {.position_m = {0.3F, 0.6F, -0.5F}, .radius_m = 0.05F, .intensity = Eigen::Vector3f::Constant(2)});
  const Insertion done = insert_model(photo, scene, few_rays());
  EXPECT_TRUE(all_finite(done.picture));
  EXPECT_GT(done.picture(48, 42, 0), 0.02F);
  EXPECT_LT(std::ranges::min(done.layers.shadow.values()), 0.5F);  // a shadow that nothing else fills
}

}  // namespace
}  // namespace faceprobe::insert

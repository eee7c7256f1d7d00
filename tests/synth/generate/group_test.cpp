#include "synth/generate/group.h"

#include "faceprobe/core/color.h"
#include "synth/generate/small_world.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

Recipe group_recipe() {
  Recipe recipe = small_recipe();
  recipe.multi_face = true;
  recipe.size_px = 192;
  recipe.count = 4;
  return recipe;
}

TEST(Group, EveryFaceIsInThePictureAndNobodyStandsInAnother) {
  const Assets assets = small_assets();
  for (int number = 0; number < 12; ++number) {
    const std::vector<Person> people = draw_people(assets, group_recipe(), number);
    ASSERT_GE(people.size(), 2U);
    ASSERT_LE(people.size(), 4U);
    const View view = draw_scene_view(people, group_recipe(), number, 0);
    for (const Person& person : people) {
      const Eigen::Isometry3f camera_from_head = view.camera.camera_from_scene * person.scene_from_head;
      for (Eigen::Index i = 0; i < person.head.landmarks.rows(); ++i) {
        const Eigen::Vector3f at = camera_from_head * Eigen::Vector3f(person.head.landmarks.row(i).transpose());
        ASSERT_LT(at.z(), 0);
        const Eigen::Vector2f pixel = view.camera.project(at);
        EXPECT_TRUE((pixel.array() > 0).all() && (pixel.array() < 192).all()) << number << ": " << pixel.transpose();
      }
    }
    for (std::size_t i = 1; i < people.size(); ++i) {
      const float apart = people[i].scene_from_head.translation().x() - people[i - 1].scene_from_head.translation().x();
      EXPECT_GT(apart, 0.5F) << number;  // a shoulder's width
    }
  }
}

TEST(Group, LampsAreUnseenAndGiveTheGroupTheIrradianceOfOne) {
  const Assets assets = small_assets();
  int found = 0;
  for (int number = 0; number < 12; ++number) {
    const std::vector<Person> people = draw_people(assets, group_recipe(), number);
    const View view = draw_scene_view(people, group_recipe(), number, 0);
    Random random({3, static_cast<std::uint64_t>(number)});
    const std::vector<NearLight> lamps = draw_lamps(people, view.camera, random);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const Person& person : people)
      middle += person.scene_from_head.translation() / static_cast<float>(people.size());
    double irradiance = 0;
    for (const NearLight& lamp : lamps) {
      const Eigen::Vector3f at = view.camera.camera_from_scene * lamp.position;
      if (at.z() < 0) {
        const Eigen::Vector2f pixel = view.camera.project(at);
        EXPECT_FALSE((pixel.array() > 0).all() && (pixel.array() < 192).all());
      }
      const float luminance = lamp.radiance.dot(kLuminanceWeights);
      const double distance = (lamp.position - middle).cast<double>().norm();
      irradiance += 3.14159265 * luminance * lamp.radius * lamp.radius / (distance * distance);
    }
    if (lamps.empty()) continue;
    ++found;
    EXPECT_NEAR(irradiance, 1.0, 1e-4);  // float rounding of the products
  }
  EXPECT_GE(found, 10);  // a group in a corner of its own may find no place for a lamp; most do
}

TEST(Group, ThePixelsOfEachFaceBelongToItsPerson) {
  const Assets assets = small_assets();
  Recipe recipe = group_recipe();
  recipe.views_per_person = 1;
  recipe.samples_per_view = 1;
  const std::vector<ViewSamples> views = generate_person(assets, recipe, 2);
  ASSERT_EQ(views.size(), 1U);
  const ViewLayers& view = views[0].view;
  ASSERT_GE(view.faces.size(), 2U);
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    // The bridge of the nose (landmark 27), where nothing is worn but glasses; somebody in front may hide it.
    const Eigen::Vector2f at = view.faces[f].landmarks_px.row(27).transpose();
    const auto owner = static_cast<int>(view.owner(static_cast<int>(at.x()), static_cast<int>(at.y())));
    EXPECT_EQ(owner, static_cast<int>(f) + 1);
  }
  EXPECT_FALSE(views[0].samples[0].lamps.empty());
  const Sample& sample = views[0].samples[0];
  for (const float value : sample.diffuse.values()) ASSERT_TRUE(std::isfinite(value) && value >= 0);
}

TEST(Group, ALoneFaceIsTheOneOfADrawnPerson) {
  const Assets assets = small_assets();
  const std::vector<Person> people = draw_people(assets, small_recipe(), 3);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].parameters.identity, draw_person(assets, small_recipe(), 3).parameters.identity);
  EXPECT_TRUE(people[0].scene_from_head.matrix().isIdentity());
}

}  // namespace
}  // namespace faceprobe::synth

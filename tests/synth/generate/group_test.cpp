#include "synth/generate/group.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/random.h"
#include "synth/generate/light_sample_draw.h"
#include "synth/generate/small_world.h"

#include <gtest/gtest.h>

#include <algorithm>

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
    const std::vector<NearLight> lamps = draw_lamps(people, view.camera, group_recipe(), random);
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

TEST(Group, ThereAreAsManyPeopleAndLampsAsAskedForAtTheDistancesAskedFor) {
  const Assets assets = small_assets();
  Recipe recipe = group_recipe();
  recipe.people = 3;
  recipe.lamps = 2;
  recipe.lamp_distance_m = {{1.0, 4.0}};
  float nearest = 100;
  float farthest = 0;
  for (int number = 0; number < 12; ++number) {
    const std::vector<Person> people = draw_people(assets, recipe, number);
    ASSERT_EQ(people.size(), 3U);
    const View view = draw_scene_view(people, recipe, number, 0);
    Random random({3, static_cast<std::uint64_t>(number)});
    const std::vector<NearLight> lamps = draw_lamps(people, view.camera, recipe, random);
    ASSERT_EQ(lamps.size(), 2U);
    for (const NearLight& lamp : lamps) {
      for (const Person& person : people) {
        const float distance = (lamp.position - person.scene_from_head.translation()).norm();
        EXPECT_GE(distance, 1.0F - 1e-5F) << number;  // float rounding
        EXPECT_LE(distance, 4.0F + 1e-5F) << number;
        nearest = std::min(nearest, distance);
        farthest = std::max(farthest, distance);
      }
    }
  }
  // 72 distances of lamps that are drawn all over the range use most of it.
  EXPECT_LT(nearest, 1.8F);
  EXPECT_GT(farthest, 3.0F);
}

TEST(Group, LampsThatHaveNoPlaceAreRefused) {
  const Assets assets = small_assets();
  Recipe recipe = group_recipe();
  recipe.people = 4;  // a metre and a half from first to last at least
  recipe.lamp_distance_m = {{0.9, 0.91}};
  const std::vector<Person> people = draw_people(assets, recipe, 0);
  const View view = draw_scene_view(people, recipe, 0, 0);
  Random random({3, 0});
  EXPECT_THROW(draw_lamps(people, view.camera, recipe, random), Error);
}

// Who asks for what would be drawn anyway gets the same: options take nothing out of the order of the draws.
TEST(Group, AskingForTheNumbersThatAreDrawnChangesNothing) {
  const Assets assets = small_assets();
  for (int number = 0; number < 4; ++number) {
    const std::vector<Person> drawn = draw_people(assets, group_recipe(), number);
    Recipe recipe = group_recipe();
    recipe.people = static_cast<int>(drawn.size());
    const std::vector<Person> asked = draw_people(assets, recipe, number);
    ASSERT_EQ(asked.size(), drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i)
      EXPECT_EQ(asked[i].scene_from_head.matrix(), drawn[i].scene_from_head.matrix());
    const View view = draw_scene_view(drawn, group_recipe(), number, 0);
    Random random({3, static_cast<std::uint64_t>(number)});
    Random same({3, static_cast<std::uint64_t>(number)});
    const std::vector<NearLight> lamps = draw_lamps(drawn, view.camera, group_recipe(), random);
    recipe.lamps = static_cast<int>(lamps.size());
    const std::vector<NearLight> again = draw_lamps(drawn, view.camera, recipe, same);
    ASSERT_EQ(again.size(), lamps.size());
    for (std::size_t l = 0; l < lamps.size(); ++l) {
      EXPECT_EQ(again[l].position, lamps[l].position);
      EXPECT_EQ(again[l].radiance, lamps[l].radiance);
    }
  }
}

// The draws of a group without options, in the order that data sets of before were made by.
TEST(Group, TheDefaultsDrawInTheOrderTheyAlwaysDid) {
  const Assets assets = small_assets();
  for (int number = 0; number < 4; ++number) {
    const Recipe recipe = group_recipe();
    const std::vector<Person> people = draw_people(assets, recipe, number);
    Random places = Random({recipe.seed, 0, static_cast<std::uint64_t>(number), 0x6209}).split(21);
    const int count = 2 + places.below(3);
    ASSERT_EQ(people.size(), static_cast<std::size_t>(count)) << number;
    places.between(1.3, 2.8);
    for (std::size_t i = 1; i < people.size(); ++i) {
      const double step = places.between(0.52, 0.95);
      const float apart = people[i].scene_from_head.translation().x() - people[i - 1].scene_from_head.translation().x();
      EXPECT_NEAR(apart, step, 1e-5) << number;  // float rounding
    }

    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const Person& person : people)
      middle += person.scene_from_head.translation() / static_cast<float>(people.size());
    const View view = draw_scene_view(people, recipe, number, 0);
    Random random({3, static_cast<std::uint64_t>(number)});
    Random drawn = random;
    const std::vector<NearLight> lamps = draw_lamps(people, view.camera, recipe, random);
    EXPECT_LE(lamps.size(), static_cast<std::size_t>(1 + drawn.below(3)));
    std::size_t met = 0;  // every lamp is one of the attempts, in their order
    for (int attempt = 0; attempt < 200 && met < lamps.size(); ++attempt) {
      const auto radius = static_cast<float>(drawn.log_between(0.02, 0.15));
      const Eigen::Vector3f place = middle + Eigen::Vector3d(drawn.between(-2.2, 2.2), drawn.between(-0.4, 1.6),
                                                             drawn.between(0.2, static_cast<double>(-middle.z()) + 1.2))
                                                 .cast<float>();
      drawn.uniform();             // colour
      drawn.normal();              // its cast
      drawn.log_between(0.25, 1);  // share of the light
      if (radius == lamps[met].radius && (place - lamps[met].position).norm() < 1e-5F) ++met;
    }
    EXPECT_EQ(met, lamps.size()) << number;
  }
}

TEST(Group, WithoutLampsTheMapAloneLightsTheGroupAsItIs) {
  const Assets assets = small_assets();
  Recipe recipe = group_recipe();
  recipe.people = 2;
  recipe.lamps = 0;
  recipe.views_per_person = 1;
  recipe.samples_per_view = 1;
  const std::vector<ViewSamples> views = generate_person(assets, recipe, 2);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].view.faces.size(), 2U);
  EXPECT_TRUE(views[0].samples[0].lamps.empty());
  // Not dimmed, and all else as it is drawn beside lamps.
  Random one({3, 1});
  Random two({3, 1});
  const SampleDraw beside_lamps = draw_sample(assets, group_recipe(), one, 0);
  const SampleDraw alone = draw_sample(assets, recipe, two, 0);
  EXPECT_GT(beside_lamps.map_level, 0);
  EXPECT_EQ(alone.map_level, 0);
  EXPECT_EQ(alone.map_yaw, beside_lamps.map_yaw);
  EXPECT_EQ(alone.exposure, beside_lamps.exposure);
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

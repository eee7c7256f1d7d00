#include "faceprobe/synth/recipe.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

TEST(Recipe, DefaultsAreUsable) { EXPECT_EQ(Recipe{}.validate(), ""); }

TEST(Recipe, SaysWhichValueIsWrong) {
  Recipe recipe;
  recipe.size_px = 7;
  EXPECT_EQ(recipe.validate(), "size is 7; allowed is 32 to 1024.");
  recipe = {};
  recipe.count = 0;
  EXPECT_NE(recipe.validate().find("count is 0"), std::string::npos);
}

TEST(Recipe, CountsPeopleUpwards) {
  Recipe recipe;
  recipe.views_per_person = 2;
  recipe.samples_per_view = 5;
  recipe.count = 20;
  EXPECT_EQ(recipe.person_count(), 2);
  recipe.count = 21;
  EXPECT_EQ(recipe.person_count(), 3);
}

TEST(Recipe, EveryFieldIsInTheJson) {
  // Two recipes that differ anywhere must not share a folder.
  const std::string usual = to_json({});
  Recipe recipe;
  recipe.nside = 8;
  EXPECT_NE(to_json(recipe), usual);
  recipe = {};
  recipe.split = Split::kDev;
  EXPECT_NE(to_json(recipe), usual);
  recipe = {};
  recipe.bounce_rays = 3;
  EXPECT_NE(to_json(recipe), usual);
}

}  // namespace
}  // namespace faceprobe::synth

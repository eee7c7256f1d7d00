#include "faceprobe/assets/named_model.h"

#include "faceprobe/core/error.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

namespace faceprobe::assets {
namespace {

using faceprobe::testing::expect_error;
using render::MaterialKind;

TEST(NamedModel, APresetIsChanged) {
  const Eigen::Vector3f copper(0.9F, 0.5F, 0.3F);
  const LoadedModel pot = model_named("pot", "gold", {.colour = copper, .roughness = 0.7F});
  ASSERT_EQ(pot.model.materials.size(), 1U);
  EXPECT_EQ(pot.model.materials[0].kind, MaterialKind::kMetal);
  EXPECT_EQ(pot.model.materials[0].colour, copper);
  EXPECT_EQ(pot.model.materials[0].roughness, 0.7F);
}

TEST(NamedModel, ItsOwnMaterialsAreChangedEach) {
  const LoadedModel plain = model_named("spheres");
  const LoadedModel rough = model_named("spheres", "", {.roughness = 0.5F});
  ASSERT_EQ(rough.model.materials.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rough.model.materials[i].roughness, 0.5F);
    EXPECT_EQ(rough.model.materials[i].kind, plain.model.materials[i].kind);
    EXPECT_EQ(rough.model.materials[i].colour, plain.model.materials[i].colour);
  }
}

TEST(NamedModel, AChangeThatWouldNotShowIsASentence) {
  expect_error(ExitCode::kUsage, {"metal and plastic"}, [] { model_named("cube", "glass", {.roughness = 0.5F}); });
  expect_error(ExitCode::kUsage, {"plastic and glass"}, [] { model_named("cube", "gold", {.ior = 1.4F}); });
  EXPECT_NO_THROW(model_named("cube", "glass", {.kind = MaterialKind::kPlastic, .roughness = 0.5F}));
  expect_error(ExitCode::kUsage, {"roughness", "from 0 to 1"}, [] { model_named("cube", "gold", {.roughness = 2}); });
  expect_error(ExitCode::kUsage, {"colour", "from 0 to 1"},
               [] { model_named("cube", "", {.colour = Eigen::Vector3f(0, -1, 0)}); });
}

}  // namespace
}  // namespace faceprobe::assets

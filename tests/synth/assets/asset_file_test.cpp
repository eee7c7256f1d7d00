#include "faceprobe/synth/asset_file.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/tensor_file.h"
#include "faceprobe/synth/procedural_head.h"
#include "faceprobe/synth/procedural_maps.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

using testing::TempFolder;

AssetSources written_and_read(const AssetSources& sources) {
  const TempFolder folder;
  write_asset_file(folder / "assets.safetensors", sources);
  return read_asset_file(folder / "assets.safetensors");
}

HeadModel head_with_everything() {
  HeadModel model = procedural_head();
  model.identity[0].conservativeResize(model.identity[0].rows() / 2, 3);  // a mode of the first vertices alone
  model.vertex_albedo = Eigen::MatrixX3f::Constant(model.neutral.rows(), 3, 0.3F);
  model.albedo_modes = {Eigen::MatrixX3f::Constant(model.neutral.rows(), 3, 0.01F)};
  model.dense_landmarks.assign(468, {1, {0.2F, 0.3F, 0.5F}});
  model.texture = ByteImage(4, 2, 3, 77);
  return model;
}

// Modes are rounded to 11 bits, and a mode of the first vertices comes back with zeros for the rest.
void expect_modes(const std::vector<Eigen::MatrixX3f>& found, const std::vector<Eigen::MatrixX3f>& modes) {
  ASSERT_EQ(found.size(), modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    ASSERT_GE(found[i].rows(), modes[i].rows());
    const float largest = modes[i].cwiseAbs().maxCoeff();
    const float allowed = std::ldexp(largest, -11) + 1e-7F;  // half of the last place; float16's smallest step is 6e-8
    EXPECT_LE((found[i].topRows(modes[i].rows()) - modes[i]).cwiseAbs().maxCoeff(), allowed) << i;
    EXPECT_TRUE(found[i].bottomRows(found[i].rows() - modes[i].rows()).isZero(0)) << i;
  }
}

TEST(AssetFile, HeadsComeBack) {
  const HeadModel model = head_with_everything();
  ASSERT_EQ(model.validate(), "");
  const AssetSources read = written_and_read({.heads = {model, procedural_head()}});
  ASSERT_EQ(read.heads.size(), 2U);
  const HeadModel& found = read.heads[0];
  EXPECT_EQ(found.name, model.name);
  EXPECT_EQ(found.neutral, model.neutral);
  expect_modes(found.identity, model.identity);
  expect_modes(found.expression, model.expression);
  expect_modes(found.albedo_modes, model.albedo_modes);
  EXPECT_EQ(found.expression_names, model.expression_names);
  EXPECT_EQ(found.triangles, model.triangles);
  EXPECT_EQ(found.triangle_material, model.triangle_material);
  EXPECT_EQ(found.uv, model.uv);
  EXPECT_EQ(found.triangle_uv, model.triangle_uv);
  EXPECT_EQ(found.uv_layout, model.uv_layout);
  EXPECT_EQ(found.vertex_region, model.vertex_region);
  EXPECT_EQ(found.landmarks, model.landmarks);
  EXPECT_EQ(found.vertex_albedo, model.vertex_albedo);
  EXPECT_EQ(found.texture, model.texture);
  ASSERT_EQ(found.dense_landmarks.size(), 468U);
  EXPECT_EQ(found.dense_landmarks[5].triangle, 1);
  EXPECT_EQ(found.dense_landmarks[5].weights, Eigen::Vector3f(0.2F, 0.3F, 0.5F));
  EXPECT_TRUE(read.heads[1].dense_landmarks.empty());
  EXPECT_EQ(read.heads[1].texture, procedural_head().texture);
}

TEST(AssetFile, SkinsAndReflectanceComeBackExactly) {
  SkinStatistics statistics;
  statistics.regions[2] = {0.25F, 0.03F, 0.2F, 0.01F, true};
  const ByteImage skin(5, 3, 3, 120);
  const AssetSources read =
      written_and_read({.skins = {{"one", skin}, {"two", ByteImage(2, 2, 3, 9)}}, .reflectance = statistics});
  ASSERT_EQ(read.skins.size(), 2U);
  EXPECT_EQ(read.skins[0].first, "one");
  EXPECT_EQ(read.skins[0].second, skin);
  EXPECT_EQ(read.skins[1].second.width(), 2);
  ASSERT_TRUE(read.reflectance.has_value());
  EXPECT_EQ(read.reflectance->regions[2].specular_albedo, 0.2F);
  EXPECT_TRUE(read.reflectance->regions[2].measured);
  EXPECT_FALSE(read.reflectance->regions[3].measured);
  EXPECT_TRUE(read.heads.empty());
}

// A sun of 300,000 is beyond float16's range, and a shadow of a thousandth beside it must not go out.
TEST(AssetFile, MapsKeepSunAndShadow) {
  EnvMap map(64, 32);
  for (float& value : map.radiance().values()) value = 0.001F;
  map.radiance()(10, 5, 0) = 300000;
  const AssetSources read = written_and_read({.maps = {{"sun", map}, procedural_maps().front()}});
  ASSERT_EQ(read.maps.size(), 2U);
  EXPECT_EQ(read.maps[0].first, "sun");
  const Image& found = read.maps[0].second.radiance();
  EXPECT_NEAR(found(10, 5, 0), 300000, 300000.0 / 2048);
  // 300,000 is scaled to under 65,504, by 1/8; what is left of float16 there has steps of 8 * 6e-8.
  EXPECT_NEAR(found(11, 5, 0), 0.001, 3e-7 + 0.001 / 2048);
  const EnvMap indoors = procedural_maps().front().second;
  EXPECT_NEAR(read.maps[1].second.integral().sum(), indoors.integral().sum(), 1e-3 * indoors.integral().sum());
}

TEST(AssetFile, WhatCannotBeKeptIsRefused) {
  const TempFolder folder;
  EnvMap map(8, 4);
  map.radiance()(0, 0, 0) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_asset_file(folder / "a", {.maps = {{"broken", map}}}), Error);
  EXPECT_THROW(write_asset_file(folder / "a", {.skins = {{"grey", ByteImage(2, 2, 1)}}}), std::invalid_argument);
  EXPECT_THROW(write_asset_file(folder / "a", {.heads = {HeadModel{}}}), Error);
}

TEST(AssetFile, OtherFilesAreRefused) {
  const TempFolder folder;
  io::TensorFileBuilder other;
  other.add<float>("numbers", {3});
  other.write(folder / "other.safetensors");
  EXPECT_THROW(read_asset_file(folder / "other.safetensors"), Error);
  // Of our own, but without the arrays that its text names.
  io::TensorFileBuilder hollow;
  hollow.add<float>("numbers", {3});
  hollow.set_metadata("faceprobe_assets", R"({"format": 1, "heads": [], "skins": ["one"], "maps": []})");
  hollow.write(folder / "hollow.safetensors");
  EXPECT_THROW(read_asset_file(folder / "hollow.safetensors"), Error);
  io::TensorFileBuilder odd;
  odd.add<float>("numbers", {3});
  odd.set_metadata("faceprobe_assets", R"({"format": 1, "heads": 3})");
  odd.write(folder / "odd.safetensors");
  EXPECT_THROW(read_asset_file(folder / "odd.safetensors"), Error);
}

}  // namespace
}  // namespace faceprobe::synth

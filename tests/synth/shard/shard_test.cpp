#include "faceprobe/synth/shard.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace faceprobe::synth {
namespace {

constexpr int kSize = 6;

class Shards : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("faceprobe_shards_" + std::to_string(::getpid()) + "_" +
                                                        ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ShardSpec spec() const { return {.size_px = kSize, .environment_height = 2, .recipe = R"({"seed":1})"}; }

  std::filesystem::path folder_;
};

// Values that half floats hold exactly: quarters below 16.
Image exact_image(Random& random, int width, int height, int channels) {
  Image image(width, height, channels);
  for (float& value : image.values()) value = 0.25F * static_cast<float>(random.below(64));
  return image;
}

FaceMarks exact_face(int person, int identities) {
  FaceMarks face;
  face.landmarks_px = Eigen::MatrixX2f::Constant(68, 2, 1.5F + static_cast<float>(person));
  face.dense_landmarks_px = Eigen::MatrixX2f::Constant(468, 2, 2.5F);
  face.camera_from_head.translation() = Eigen::Vector3f(0.125F, static_cast<float>(person), -2);
  face.identity = Eigen::VectorXf::LinSpaced(identities, 0, 1);
  face.expression = Eigen::VectorXf::Constant(3, 0.5F);
  face.person = person;
  return face;
}

ViewSamples exact_view(Random& random, int samples, int faces) {
  ViewSamples out;
  out.view.normal = exact_image(random, kSize, kSize, 3);
  out.view.depth_m = exact_image(random, kSize, kSize, 1);
  out.view.region = ByteImage(kSize, kSize, 1, 3);
  out.view.owner = ByteImage(kSize, kSize, 1, 1);
  out.view.focal_px = 12.5F;
  out.view.centre_px = {3, 2.5F};
  for (int f = 0; f < faces; ++f) out.view.faces.push_back(exact_face(10 + f, 4));
  for (int s = 0; s < samples; ++s) {
    Sample sample;
    sample.photo = ByteImage(kSize, kSize, 3, static_cast<std::uint8_t>(random.below(256)));
    sample.clip = ByteImage(kSize, kSize, 1, 5);
    sample.highlight = exact_image(random, kSize, kSize, 3);
    sample.diffuse = exact_image(random, kSize, kSize, 3);
    sample.albedo = exact_image(random, kSize, kSize, 3);
    sample.shading = exact_image(random, kSize, kSize, 3);
    sample.environment = EnvMap(exact_image(random, 4, 2, 3));
    sample.map = s;
    sample.map_yaw = 0.5F;
    sample.settings_json = R"({"sample":)" + std::to_string(s) + "}";
    out.samples.push_back(std::move(sample));
  }
  return out;
}

void expect_same(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.photo, b.photo);
  EXPECT_EQ(a.clip, b.clip);
  EXPECT_EQ(a.highlight, b.highlight);
  EXPECT_EQ(a.diffuse, b.diffuse);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.shading, b.shading);
  EXPECT_EQ(a.environment.radiance(), b.environment.radiance());
  EXPECT_EQ(a.map, b.map);
  EXPECT_EQ(a.map_yaw, b.map_yaw);
  EXPECT_EQ(a.settings_json, b.settings_json);
  ASSERT_EQ(a.lamps.size(), b.lamps.size());
  for (std::size_t l = 0; l < a.lamps.size(); ++l) {
    EXPECT_EQ(a.lamps[l].position, b.lamps[l].position);
    EXPECT_EQ(a.lamps[l].radius, b.lamps[l].radius);
    EXPECT_EQ(a.lamps[l].radiance, b.lamps[l].radiance);
  }
}

void expect_same(const ViewLayers& a, const ViewLayers& b) {
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.depth_m, b.depth_m);
  EXPECT_EQ(a.region, b.region);
  EXPECT_EQ(a.owner, b.owner);
  EXPECT_EQ(a.focal_px, b.focal_px);
  EXPECT_EQ(a.centre_px, b.centre_px);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(a.faces[f].landmarks_px, b.faces[f].landmarks_px);
    EXPECT_EQ(a.faces[f].dense_landmarks_px, b.faces[f].dense_landmarks_px);
    EXPECT_EQ(a.faces[f].camera_from_head.matrix(), b.faces[f].camera_from_head.matrix());
    EXPECT_EQ(a.faces[f].identity, b.faces[f].identity);
    EXPECT_EQ(a.faces[f].expression, b.faces[f].expression);
    EXPECT_EQ(a.faces[f].person, b.faces[f].person);
  }
}

TEST_F(Shards, GiveBackWhatWasWritten) {
  Random random({1});
  // Views with different numbers of faces and samples with different numbers of lamps share a file.
  std::vector<ViewSamples> views = {exact_view(random, 2, 1), exact_view(random, 1, 3)};
  views[1].samples[0].lamps = {{{1, 2, -3}, 0.125F, {4, 5, 6}}, {{0, 1, 0}, 0.5F, {1, 1, 1}}};
  const ShardWriter writer(folder_, spec());
  EXPECT_FALSE(writer.has(0));
  writer.write(0, views);
  EXPECT_TRUE(writer.has(0));
  const std::vector<ViewSamples> second = {exact_view(random, 1, 1)};
  writer.write(1, second);
  writer.finish(2, "# card\n");

  const ShardReader reader(folder_);
  ASSERT_EQ(reader.sample_count(), 4);
  expect_same(reader.copy_sample(0), views[0].samples[0]);
  expect_same(reader.copy_sample(1), views[0].samples[1]);
  expect_same(reader.copy_sample(2), views[1].samples[0]);
  expect_same(reader.copy_sample(3), second[0].samples[0]);
  expect_same(reader.copy_view(1), views[0].view);
  expect_same(reader.copy_view(2), views[1].view);
  EXPECT_EQ(reader.recipe(), R"({"seed":1})");
}

TEST_F(Shards, MeshesComeBackForTheSamplesOfTheirViews) {
  Random random({4});
  const std::vector<ViewSamples> views = {exact_view(random, 2, 1), exact_view(random, 1, 1)};
  const ShardWriter writer(folder_, spec());
  writer.write(0, views);
  writer.finish(1, "");
  EXPECT_FALSE(ShardReader(folder_).has_meshes());
  std::vector<FoundMesh> meshes;
  for (int v = 0; v < 2; ++v)
    meshes.push_back(
        {exact_image(random, kSize, kSize, 3), ByteImage(kSize, kSize, 1, static_cast<std::uint8_t>(3 + v))});
  write_meshes(folder_, 0, meshes);
  const ShardReader reader(folder_);
  ASSERT_TRUE(reader.has_meshes());
  EXPECT_EQ(reader.view_place(1), (std::pair{0, 0}));
  EXPECT_EQ(reader.view_place(2), (std::pair{0, 1}));
  EXPECT_EQ(reader.copy_mesh(1).normal_cam, meshes[0].normal_cam);
  EXPECT_EQ(reader.copy_mesh(2).normal_cam, meshes[1].normal_cam);
  EXPECT_EQ(reader.copy_mesh(2).region, meshes[1].region);
  EXPECT_EQ(reader.person(2), views[1].view.faces[0].person);
  meshes.pop_back();
  write_meshes(folder_, 0, meshes);
  EXPECT_THROW(ShardReader{folder_}, Error);
}

TEST_F(Shards, SeveralFoldersAreReadAsOne) {
  Random random({7});
  std::vector<std::filesystem::path> folders;
  std::vector<ViewSamples> views;
  std::vector<FoundMesh> meshes;
  for (const int samples : {2, 1}) {
    const std::filesystem::path folder = folder_ / std::to_string(samples);
    const ShardWriter writer(folder, spec());
    views.push_back(exact_view(random, samples, 1));
    meshes.push_back({exact_image(random, kSize, kSize, 3), ByteImage(kSize, kSize, 1, 3)});
    writer.write(0, {&views.back(), 1});
    writer.finish(1, "");
    folders.push_back(folder);
  }
  write_meshes(folders[0], 0, {meshes.data(), 1});
  EXPECT_FALSE(ShardReader(folders).has_meshes());  // not all have them
  write_meshes(folders[1], 0, {&meshes[1], 1});
  const ShardReader reader(folders);
  ASSERT_EQ(reader.sample_count(), 3);
  expect_same(reader.copy_sample(1), views[0].samples[1]);
  expect_same(reader.copy_sample(2), views[1].samples[0]);
  expect_same(reader.copy_view(2), views[1].view);
  EXPECT_EQ(reader.copy_mesh(1).normal_cam, meshes[0].normal_cam);
  EXPECT_EQ(reader.copy_mesh(2).normal_cam, meshes[1].normal_cam);
  EXPECT_EQ(reader.recipe(), R"([{"seed":1},{"seed":1}])");
  EXPECT_THROW(ShardReader(std::vector<std::filesystem::path>{}), std::invalid_argument);
}

TEST_F(Shards, AFolderOfAnotherRecipeIsRefusedByNameOfTheDifference) {
  const ShardWriter writer(folder_, spec());
  ShardSpec other = spec();
  other.recipe = R"({"seed":2})";
  try {
    const ShardWriter again(folder_, other);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_NE(std::string(error.what()).find("seed is 1 there and 2 here"), std::string::npos) << error.what();
  }
}

TEST_F(Shards, WhatAKilledRunLeftIsRemoved) {
  const ShardWriter writer(folder_, spec());
  const std::filesystem::path leftover = folder_ / ".shard-00000.123.tmp.safetensors";
  std::ofstream(leftover) << "half";
  const ShardWriter again(folder_, spec());
  EXPECT_FALSE(std::filesystem::exists(leftover));
}

TEST_F(Shards, ADamagedIndexOrShardIsRefused) {
  Random random({2});
  const std::vector<ViewSamples> views = {exact_view(random, 1, 1)};
  const ShardWriter writer(folder_, spec());
  writer.write(0, views);
  writer.finish(1, "");
  const auto refused = [&] {
    try {
      const ShardReader reader(folder_);
      return false;
    } catch (const Error& error) {
      return error.code() == ExitCode::kInput;
    }
  };
  EXPECT_FALSE(refused());
  const std::filesystem::path shard = folder_ / shard_name(0);
  std::filesystem::resize_file(shard, std::filesystem::file_size(shard) - 1);
  EXPECT_TRUE(refused());
  std::filesystem::remove(shard);
  EXPECT_TRUE(refused());
  std::ofstream(folder_ / "index.json") << R"({"shards":[{"file":"../elsewhere"}]})";
  EXPECT_TRUE(refused());
  std::ofstream(folder_ / "index.json") << "[";
  EXPECT_TRUE(refused());
}

}  // namespace
}  // namespace faceprobe::synth

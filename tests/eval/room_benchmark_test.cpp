#include "faceprobe/eval/room_benchmark.h"

#include "eval/small_faces.h"
#include "faceprobe/core/error.h"

#include <gtest/gtest.h>

namespace faceprobe::eval {
namespace {

const Eigen::Vector3f kLamp(0.3F, 0.8F, -0.7F);

// Two people and one lamp, or none; the pictures do not matter here.
struct SmallGroup {
  explicit SmallGroup(bool lit = true) {
    constexpr int kSize = 32;
    synth::ViewSamples out;
    out.view.normal = Image(kSize, kSize, 3);
    out.view.depth_m = Image(kSize, kSize, 1, 1.0F);
    out.view.region = out.view.owner = ByteImage(kSize, kSize, 1, 1);
    out.view.focal_px = 40;
    out.view.centre_px = {kSize / 2.0F, kSize / 2.0F};
    out.view.faces.resize(2);
    for (std::size_t f = 0; f < 2; ++f) {
      out.view.faces[f].person = static_cast<int>(f);
      out.view.faces[f].camera_from_head.translation() = place(static_cast<int>(f)).cast<float>();
    }
    synth::Sample sample;
    sample.photo = ByteImage(kSize, kSize, 3);
    sample.clip = ByteImage(kSize, kSize, 1);
    sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(kSize, kSize, 3);
    sample.environment = EnvMap(4, 2);
    sample.settings_json = "{}";
    if (lit) sample.lamps = {{kLamp, 0.1F, {5, 5, 5}}};
    out.samples.push_back(sample);
    const synth::ShardWriter writer(path(), {.size_px = kSize, .environment_height = 2, .recipe = "{}"});
    writer.write(0, std::vector<synth::ViewSamples>{out});
    writer.finish(1, "");
  }
  static Eigen::Vector3d place(int face) {
    return face == 0 ? Eigen::Vector3d(-0.5, 0, -2) : Eigen::Vector3d(0.6, 0.1, -2.2);
  }
  std::filesystem::path path() const { return folder / "data"; }

  testing::TempFolder folder;
};

std::vector<lighting::FaceLights> see(const Eigen::Vector3d& shift, bool swapped = false) {
  std::vector<lighting::FaceLights> faces;
  for (const int f : {0, 1}) {
    lighting::MainLight light;
    const Eigen::Vector3d offset = kLamp.cast<double>() - SmallGroup::place(f);
    light.direction = offset.normalized();
    light.irradiance = 1 / offset.squaredNorm();
    light.colour = Eigen::Vector3d::Ones();
    faces.push_back({SmallGroup::place(f) + shift, 0.05, {light}});
  }
  if (swapped) std::swap(faces[0], faces[1]);
  return faces;
}

double mean(const ScoreTable& table, const std::string& metric, const std::string& method) {
  return table.summary(metric, {.method = method}).mean;
}

TEST(RoomBenchmark, FacesOffByAStepPutTheLampOffByThatStep) {
  const SmallGroup small;
  const synth::ShardReader groups(small.path());
  const Eigen::Vector3d shift(0, 0.1, 0.05);
  for (const bool swapped : {false, true}) {
    const ScoreTable table =
        measure_rooms(groups, [&](const PhotoInput&) { return see(shift, swapped); }, {.samples = 1});
    EXPECT_NEAR(mean(table, "face_m", "faces as found"), shift.norm(), 1e-6);
    // Everything has moved as a whole.
    EXPECT_NEAR(mean(table, "lamp_m", "faces as found"), shift.norm(), 0.02);
    EXPECT_NEAR(mean(table, "lamp_m", "faces known"), 0, 0.02);
    EXPECT_EQ(mean(table, "found", "faces known"), 1);
    EXPECT_EQ(mean(table, "within", "faces known"), 1);
    EXPECT_EQ(mean(table, "face_found", "faces as found"), 1);
    EXPECT_EQ(mean(table, "covered", "faces as found"), 1);
    EXPECT_EQ(mean(table, "invented", "faces as found"), 0);
  }
}

TEST(RoomBenchmark, WhatIsNotFoundIsMissingAndWhatIsNotThereIsInvented) {
  const SmallGroup small;
  const synth::ShardReader groups(small.path());
  const ScoreTable blind =
      measure_rooms(groups, [](const PhotoInput&) { return std::vector<lighting::FaceLights>(); }, {.samples = 1});
  EXPECT_EQ(blind.summary("lamp_m", {.method = "faces as found"}).count, 0U);
  EXPECT_EQ(mean(blind, "found", "faces as found"), 0);
  EXPECT_EQ(mean(blind, "within", "faces as found"), 0);
  EXPECT_EQ(mean(blind, "face_found", "faces as found"), 0);
  EXPECT_EQ(blind.summary("face_m", {.method = "faces as found"}).count, 0U);
  const ScoreTable ghost =
      measure_rooms(groups,
                    [](const PhotoInput&) {
                      std::vector<lighting::FaceLights> faces = see(Eigen::Vector3d::Zero());
                      for (const int f : {0, 1}) {
                        lighting::MainLight light = faces[static_cast<std::size_t>(f)].lights[0];
                        light.direction = (Eigen::Vector3d(-0.2, -0.6, -1.2) - SmallGroup::place(f)).normalized();
                        light.colour = Eigen::Vector3d(2.5, 0.5, 0.5);
                        faces[static_cast<std::size_t>(f)].lights.push_back(light);
                      }
                      return faces;
                    },
                    {.samples = 1});
  EXPECT_EQ(mean(ghost, "invented", "faces known"), 1);
  EXPECT_EQ(mean(ghost, "inventing", "faces known"), 1);
  EXPECT_THROW(measure_rooms(groups, nullptr, {.samples = 0}), Error);
}

TEST(RoomBenchmark, UnderDistantLightAloneEveryLampIsInvented) {
  const SmallGroup small(false);
  const synth::ShardReader groups(small.path());
  // A lamp in the middle of the room that is not there ...
  const ScoreTable table = measure_rooms(groups, [](const PhotoInput&) { return see({0, 0, 0}); }, {.samples = 1});
  for (const char* method : {"faces as found", "faces known"}) {
    EXPECT_EQ(mean(table, "invented", method), 1);
    EXPECT_EQ(mean(table, "inventing", method), 1);
  }
  EXPECT_FALSE(table.metrics().contains("found"));
  EXPECT_EQ(mean(table, "face_found", "faces as found"), 1);
  // ... and light from one direction for both faces, which is no lamp.
  const ScoreTable distant = measure_rooms(groups,
                                           [](const PhotoInput&) {
                                             std::vector<lighting::FaceLights> faces = see({0, 0, 0});
                                             for (lighting::FaceLights& face : faces) {
                                               face.lights[0].direction = Eigen::Vector3d(0.3, 0.5, 0.8).normalized();
                                               face.lights[0].irradiance = 1;
                                             }
                                             return faces;
                                           },
                                           {.samples = 1});
  EXPECT_EQ(mean(distant, "invented", "faces as found"), 0);
  EXPECT_EQ(mean(distant, "inventing", "faces as found"), 0);
}

}  // namespace
}  // namespace faceprobe::eval

#include "faceprobe/pipeline/room.h"

#include "faceprobe/core/error.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {
namespace {

// Two people who see one lamp exactly.
Estimate two_faces(const Eigen::Vector3d& lamp_m) {
  Estimate estimate;
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(-0.6, 0, -2), Eigen::Vector3d(0.7, 0.1, -2.2)}) {
    FaceEstimate face;
    face.face.camera_from_face.translation() = place;
    lighting::MainLight light;
    light.direction = (lamp_m - place).normalized();
    light.colour = Eigen::Vector3d::Ones();
    light.irradiance = 2 / (lamp_m - place).squaredNorm();
    light.solid_angle_sr = 0.25;
    light.share = 0.5;
    face.lights = {light};
    estimate.faces.push_back(std::move(face));
  }
  return estimate;
}

TEST(Room, ALampThatBothFacesSeeIsFoundAndTold) {
  const Eigen::Vector3d lamp(0.2, 0.9, -0.9);
  const Room room = find_lamps(two_faces(lamp));
  ASSERT_EQ(room.lamps.size(), 1U);
  EXPECT_TRUE(room.lamps[0].near);
  EXPECT_LT((room.lamps[0].position_m - lamp).norm(), 0.02);  // where the search ends
  const auto json = nlohmann::json::parse(room_json(room, "two.jpg"));
  EXPECT_EQ(json["schema"], "faceprobe-room/1");
  EXPECT_EQ(json["faces"].size(), 2U);
  EXPECT_NEAR(json["lamps"][0]["position_m"][1].get<double>(), lamp.y(), 0.02);
  EXPECT_EQ(json["lamps"][0]["seen_by"].size(), 2U);
  EXPECT_EQ(json["faces"][1]["main_lights"][0]["solid_angle_sr"], 0.25);
  EXPECT_EQ(json["faces"][1]["main_lights"][0]["share_of_energy"], 0.5);
  EXPECT_GT(json["lamps"][0]["position_deviation_m"].get<double>(), 0.02);
}

TEST(Room, TheGltfHasEverythingWhereItIs) {
  const Room room = find_lamps(two_faces({0.2, 0.9, -0.9}));
  const auto gltf =
      nlohmann::json::parse(room_gltf(room, {.focal_px = 800, .centre_x_px = 400, .centre_y_px = 300}, 800, 600));
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  ASSERT_EQ(gltf["nodes"].size(), 4U);  // camera, two faces, lamp
  EXPECT_NEAR(gltf["cameras"][0]["perspective"]["yfov"].get<double>(), 2 * std::atan(300.0 / 800), 1e-12);
  EXPECT_EQ(gltf["nodes"][3]["extensions"]["KHR_lights_punctual"]["light"], 0);
  EXPECT_NEAR(gltf["nodes"][3]["translation"][0].get<double>(), room.lamps[0].position_m.x(), 1e-9);
  const auto& light = gltf["extensions"]["KHR_lights_punctual"]["lights"][0];
  EXPECT_EQ(light["type"], "point");
  EXPECT_NEAR(light["intensity"].get<double>(), 2, 0.1);
}

TEST(Room, ADistantLightShinesFromWhereItIs) {
  Estimate estimate = two_faces({0, 1, 0});
  const Eigen::Vector3d sun = Eigen::Vector3d(0.5, 0.7, 0.4).normalized();
  for (FaceEstimate& face : estimate.faces) {
    face.lights[0].direction = sun;
    face.lights[0].irradiance = 3;
  }
  const Room room = find_lamps(estimate);
  ASSERT_EQ(room.lamps.size(), 1U);
  EXPECT_FALSE(room.lamps[0].near);
  EXPECT_LT((room.lamps[0].direction - sun).norm(), 1e-6);
  const auto gltf = nlohmann::json::parse(room_gltf(room, {.focal_px = 800}, 800, 600));
  const auto& q = gltf["nodes"][3]["rotation"];
  const Eigen::Quaterniond turn(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>());
  EXPECT_LT((turn * -Eigen::Vector3d::UnitZ() + sun).norm(), 1e-6);  // it shines along its -z, away from the sun
}

TEST(Room, OneFaceIsASentence) {
  try {
    find_lamps(testing::portrait_estimate());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kNoFace);
    EXPECT_NE(std::string(error.what()).find("two at least"), std::string::npos);
  }
}

TEST(Room, IsDrawnWithWhatThereIs) {
  const ByteImage with = draw_room(find_lamps(two_faces({0.2, 0.9, -0.9})));
  EXPECT_EQ(with.width(), 1280);
  EXPECT_EQ(with.height(), 640);
  Room empty = find_lamps(two_faces({0.2, 0.9, -0.9}));
  empty.lamps.clear();
  EXPECT_NE(draw_room(empty), with);
  EXPECT_FALSE(draw_room(Room{}).empty());
}

}  // namespace
}  // namespace faceprobe::pipeline

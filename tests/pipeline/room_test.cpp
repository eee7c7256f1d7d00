#include "faceprobe/pipeline/room.h"

#include "faceprobe/core/error.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

// RFC 4648, of whole groups of four.
std::string bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t i = 0; i + 4 <= base64.size(); i += 4) {
    std::uint32_t bits = 0;
    int padding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t digit = digits.find(base64[i + k]);
      padding += digit == std::string::npos ? 1 : 0;
      bits = bits << 6U | static_cast<std::uint32_t>(digit == std::string::npos ? 0 : digit);
    }
    for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 255U);
  }
  return bytes;
}

// The numbers of an accessor, row by row.
template <class Number>
std::vector<Number> numbers_of(const nlohmann::json& gltf, const nlohmann::json& accessor_number) {
  const auto& accessor = gltf.at("accessors").at(accessor_number.get<std::size_t>());
  const auto& view = gltf.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const auto& buffer = gltf.at("buffers").at(0);
  const std::string uri = buffer.at("uri");
  const std::string bytes = bytes_of(uri.substr(uri.find(',') + 1));
  EXPECT_EQ(bytes.size(), buffer.at("byteLength").get<std::size_t>());
  const std::size_t offset = view.at("byteOffset");
  const std::size_t length = view.at("byteLength");
  EXPECT_EQ(offset % 4, 0U);
  std::vector<Number> numbers(length / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data() + offset, length);
  EXPECT_EQ(numbers.size(), accessor.at("count").get<std::size_t>() * (accessor.at("type") == "VEC3" ? 3 : 1));
  return numbers;
}

TEST(Room, TheWrittenGltfHasTheFacesMeshes) {
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  Estimate estimate = two_faces({0.2, 0.9, -0.9});
  estimate.camera = {800, 400, 300};
  estimate.photo_width = 800;
  estimate.photo_height = 600;
  for (FaceEstimate& face : estimate.faces) {
    face.face.camera_from_face.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
    face.face.vertices_cam_m =
        (face.face.camera_from_face * mesh.vertices_m.cast<double>().transpose()).transpose().cast<float>();
  }
  const testing::TempFolder folder;
  const auto files = write_room(folder / "room", find_lamps(estimate), estimate, "two.jpg");
  ASSERT_EQ(files.size(), 3U);
  const auto gltf = nlohmann::json::parse(std::ifstream(folder / "room/room.gltf"));
  ASSERT_EQ(gltf["meshes"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& node = gltf["nodes"][1 + i];
    const Eigen::Vector3d place(node["translation"][0], node["translation"][1], node["translation"][2]);
    const auto& primitive = gltf["meshes"][node.at("mesh").get<std::size_t>()]["primitives"][0];
    const auto positions = numbers_of<float>(gltf, primitive["attributes"]["POSITION"]);
    const auto normals = numbers_of<float>(gltf, primitive["attributes"]["NORMAL"]);
    const auto corners = numbers_of<std::uint16_t>(gltf, primitive["indices"]);
    ASSERT_EQ(positions.size(), 468U * 3);
    ASSERT_EQ(normals.size(), positions.size());
    ASSERT_EQ(corners.size(), 898U * 3);
    const auto& accessor = gltf["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    for (Eigen::Index v = 0; v < 468; ++v) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        const float value = positions[static_cast<std::size_t>(3 * v + c)];
        ASSERT_NEAR(static_cast<double>(value) + place[c], estimate.faces[i].face.vertices_cam_m(v, c), 1e-6);  // floats
        ASSERT_GE(value, accessor["min"][static_cast<std::size_t>(c)].get<float>());
        ASSERT_LE(value, accessor["max"][static_cast<std::size_t>(c)].get<float>());
      }
    }
    // Outwards: the nose's tip looks where the face does.
    const Eigen::Vector3f tip = Eigen::Map<const Eigen::Vector3f>(normals.data() + 3);
    EXPECT_NEAR(tip.norm(), 1, 1e-5);
    EXPECT_GT(tip.dot(estimate.faces[i].face.camera_from_face.linear().col(2).cast<float>()), 0.7);
    for (std::size_t k = 0; k < corners.size(); ++k)
      ASSERT_EQ(corners[k], mesh.triangles(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)));
  }
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

// docs/room_and_insert.md lists every field of room.json and insert.json, and no others.

#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/pipeline/room.h"
#include "faceprobe/render/shapes.h"
#include "pipeline/documented_fields.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {
namespace {

using nlohmann::json;

using testing::add_fields;
using testing::documented_fields;
using testing::Field;

json room_with_both_lamps() {
  Room room;
  room.faces.resize(2);
  for (lighting::FaceLights& face : room.faces) {
    face.position_m = Eigen::Vector3d(0, 0, -1);
    face.lights = {{.direction = Eigen::Vector3d::UnitY(), .colour = Eigen::Vector3d::Ones(), .irradiance = 1}};
  }
  room.lamps.resize(2);
  room.lamps[0].near = true;
  room.lamps[0].seen = room.lamps[1].seen = {{0, 0}, {1, 0}};
  return json::parse(room_json(room, "party.jpg"));
}

json insertion_with_a_lamp() {
  insert::Scene scene;
  scene.model = render::cube();
  scene.lamps.emplace_back();
  return json::parse(insertion_json({}, scene, "portrait.jpg", "cube"));
}

TEST(RoomAndInsertPages, NameEveryFieldAndNoOther) {
  std::set<Field> written;
  add_fields(room_with_both_lamps(), "room.json", written);
  add_fields(insertion_with_a_lamp(), "insert.json", written);
  ASSERT_GT(written.size(), 40U);
  const std::set<Field> documented = documented_fields("room_and_insert.md");
  for (const auto& [object, name] : written)
    EXPECT_TRUE(documented.contains({object, name})) << object << '.' << name << " is not in docs/room_and_insert.md";
  for (const auto& [object, name] : documented)
    EXPECT_TRUE(written.contains({object, name})) << object << '.' << name << " of the page is in neither file";
}

}  // namespace
}  // namespace faceprobe::pipeline

// docs/room_and_insert.md lists every field of room.json and insert.json, and no others.

#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/pipeline/room.h"
#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {
namespace {

using nlohmann::json;

// An object as the page names it, and one of its fields. Objects go by the last name on the way to them.
using Field = std::pair<std::string, std::string>;

void add_fields(const json& value, const std::string& object, std::set<Field>& fields) {
  if (value.is_array()) {
    for (const json& item : value) add_fields(item, object, fields);
  }
  if (!value.is_object()) return;
  for (const auto& [name, item] : value.items()) {
    fields.emplace(object, name);
    add_fields(item, name, fields);
  }
}

std::vector<std::string> names_in(const std::string& text) {
  static const std::regex name("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) names.push_back((*it)[1].str());
  return names;
}

// Headings name the objects, the first column of their tables the fields.
std::set<Field> documented_fields() {
  const auto page =
      std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "docs" / "room_and_insert.md";
  std::ifstream file(page);
  EXPECT_TRUE(file.is_open()) << page;
  std::set<Field> fields;
  std::string object;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) object = names_in(line).at(0);
    if (!line.starts_with("| `")) continue;
    for (const std::string& name : names_in(line.substr(0, line.find('|', 1)))) fields.emplace(object, name);
  }
  return fields;
}

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
  const std::set<Field> documented = documented_fields();
  for (const auto& [object, name] : written)
    EXPECT_TRUE(documented.contains({object, name})) << object << '.' << name << " is not in docs/room_and_insert.md";
  for (const auto& [object, name] : documented)
    EXPECT_TRUE(written.contains({object, name})) << object << '.' << name << " of the page is in neither file";
}

}  // namespace
}  // namespace faceprobe::pipeline

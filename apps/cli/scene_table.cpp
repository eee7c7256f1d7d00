#include "scene_table.h"

#include "faceprobe/core/error.h"
#include "paper/csv.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace faceprobe::cli {

namespace {

std::size_t column(const std::vector<std::string>& head, const std::string& name, const std::filesystem::path& table) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (head[i] == name) return i;
  }
  throw Error(ExitCode::kInput, table.string() + " has no column \"" + name + "\" in its first line.");
}

}  // namespace

std::function<std::string(int map)> scene_of_maps(const std::filesystem::path& table, const std::string& recipe,
                                                  const std::string& kind) {
  std::ifstream file(table);
  std::string line;
  if (!std::getline(file, line)) throw Error(ExitCode::kInput, table.string() + " cannot be read, or is empty.");
  const std::vector<std::string> head = csv_fields(line);
  const std::size_t name = column(head, "name", table);
  const std::size_t scene_kind = column(head, kind, table);
  std::map<std::string, std::string> scene;
  while (std::getline(file, line)) {
    const std::vector<std::string> record = csv_fields(line);
    if (record.size() > std::max(name, scene_kind)) scene[record[name]] = record[scene_kind];
  }
  std::vector<std::string> of_map;
  const nlohmann::json json = nlohmann::json::parse(recipe, nullptr, false);
  if (json.is_object() && json.contains("maps")) {
    for (const auto& map : json["maps"]) {
      if (!map.is_string())
        throw Error(ExitCode::kInput, "The data's recipe names a map that is no text. Make the data again.");
      const auto found = scene.find(map.get<std::string>());
      of_map.push_back(found == scene.end() ? "unknown" : found->second);
    }
  }
  return [of_map](int map) {
    const auto i = static_cast<std::size_t>(map);
    return i < of_map.size() ? of_map[i] : std::string("unknown");
  };
}

std::vector<std::size_t> maps_of_kind(const std::vector<std::string>& maps, const std::vector<std::string>& tables,
                                      SceneKind kind) {
  const std::string recipe = nlohmann::json{{"maps", maps}}.dump();
  std::vector<char> wanted(maps.size(), 0);
  for (const std::string& table : tables) {
    const auto folder_of = scene_of_maps(table, recipe);
    const auto scene_of = scene_of_maps(table, recipe, "scene");
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const int map = static_cast<int>(i);
      const bool of_kind = kind == SceneKind::kIndoor ? folder_of(map) == "indoor"
                                                      : folder_of(map) == "outdoor" && scene_of(map) != "night";
      if (of_kind) wanted[i] = 1;
    }
  }
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (wanted[i] != 0) numbers.push_back(i);
  }
  return numbers;
}

}  // namespace faceprobe::cli

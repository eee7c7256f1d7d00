#include "paper/london_set.h"

#include "faceprobe/core/error.h"
#include "paper/csv.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>

namespace faceprobe::cli {

namespace {

std::vector<Eigen::Vector3d> read_lights(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<Eigen::Vector3d> lights;
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    for (const auto& light : json.at("lights")) {
      const auto direction = light.at("direction_x_right_y_up_z_to_camera").get<std::array<double, 3>>();
      lights.push_back(Eigen::Vector3d(direction[0], direction[1], direction[2]).normalized());
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::kInput, file.string() + " is missing or no list of lights: " + error.what());
  }
  if (lights.empty()) throw Error(ExitCode::kInput, file.string() + " lists no lights.");
  return lights;
}

// Number of the person -> what the set's table says; empty without a table.
std::map<std::string, std::string> ethnicities(const std::filesystem::path& file) {
  std::map<std::string, std::string> by_id;
  if (!std::filesystem::exists(file)) return by_id;
  const CsvTable table = read_csv(file);
  const std::size_t id = table.column("face_id");
  const std::size_t ethnicity = table.column("face_eth");
  for (const auto& row : table.rows) {
    std::string text = row[ethnicity];
    std::replace(text.begin(), text.end(), '_', ' ');
    by_id[row[id]] = text;
  }
  return by_id;
}

// By the person's number, the first three signs of the name.
std::map<std::string, std::filesystem::path> photos_by_person(const std::filesystem::path& folder) {
  std::map<std::string, std::filesystem::path> photos;
  if (!std::filesystem::is_directory(folder)) return photos;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    const std::filesystem::path extension = path.extension();
    if (extension != ".jpg" && extension != ".jpeg" && extension != ".png") continue;
    photos[path.stem().string().substr(0, 3)] = path;
  }
  return photos;
}

}  // namespace

LondonSet read_london(const std::filesystem::path& folder, int every) {
  LondonSet london{read_lights(folder / "lights_from_catchlights.json"), {}};
  const std::map<std::string, std::string> ethnicity = ethnicities(folder / "london_info.csv");
  const std::map<std::string, std::filesystem::path> smiling = photos_by_person(folder / "smiling_front");
  int usable = 0;
  for (const auto& [id, neutral] : photos_by_person(folder / "neutral_front")) {
    const auto smile = smiling.find(id);
    if (smile == smiling.end() || usable++ % every != 0) continue;
    const auto known = ethnicity.find(id);
    london.people.push_back({id, neutral, smile->second, known == ethnicity.end() ? "" : known->second});
  }
  return london;
}

}  // namespace faceprobe::cli

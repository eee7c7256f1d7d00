#include "scene_maps.h"

#include "faceprobe/assets/maps.h"

#include <spdlog/spdlog.h>

namespace faceprobe::cli {

std::vector<std::pair<std::string, EnvMap>> load_scene_maps(const std::filesystem::path& folder,
                                                            const std::vector<std::string>& scenes, SceneKind kind) {
  std::vector<std::pair<std::string, EnvMap>> maps;
  if (folder.empty()) return maps;
  maps = assets::load_maps(folder);
  if (scenes.empty()) return maps;
  std::vector<std::string> names;
  names.reserve(maps.size());
  for (const auto& [name, map] : maps) names.push_back(name);
  std::vector<std::pair<std::string, EnvMap>> taken;
  for (const std::size_t number : maps_of_kind(names, scenes, kind)) taken.push_back(std::move(maps[number]));
  spdlog::info("{} of the {} maps in {} are {}", taken.size(), maps.size(), folder.string(),
               kind == SceneKind::kIndoor ? "indoor" : "outdoor and by day");
  return taken;
}

}  // namespace faceprobe::cli

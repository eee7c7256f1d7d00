#pragma once
// What kinds of scene a data set's maps show, from a table beside the maps.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::cli {

// `table`: CSV whose first line names a column "name" and a column "folder" ("indoor", "outdoor"). `recipe`: ShardReader::recipe(), which
// names the maps. A map that the table does not have is of scene "unknown". Throws Error(kInput).
// `kind`: another column to say the scene by.
std::function<std::string(int map)> scene_of_maps(const std::filesystem::path& table, const std::string& recipe,
                                                  const std::string& kind = "folder");

enum class SceneKind { kIndoor, kOutdoorByDay };
// Numbers of those of `maps`, by name, that one of the tables says are of that kind: "indoor" or "outdoor" in its column "folder", and outdoors not
// "night" in its column "scene". Throws Error(kInput).
std::vector<std::size_t> maps_of_kind(const std::vector<std::string>& maps, const std::vector<std::string>& tables,
                                      SceneKind kind);

}  // namespace faceprobe::cli

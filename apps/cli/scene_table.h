#pragma once
// What kinds of scene a data set's maps show, from a table beside the maps.

#include <filesystem>
#include <functional>
#include <string>

namespace faceprobe::cli {

// `table`: CSV whose first line names a column "name" and a column "folder" ("indoor", "outdoor"). `recipe`: ShardReader::recipe(), which
// names the maps. A map that the table does not have is of scene "unknown". Throws Error(kInput).
// `kind`: another column to say the scene by.
std::function<std::string(int map)> scene_of_maps(const std::filesystem::path& table, const std::string& recipe,
                                                  const std::string& kind = "folder");

}  // namespace faceprobe::cli

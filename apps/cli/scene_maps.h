#pragma once
// Environment maps to learn from, of one kind of scene.

#include "faceprobe/core/env_map.h"
#include "scene_table.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

// The folder's maps with their names, those of that kind by `scenes` (maps_of_kind()); without tables all, without a folder none. Logs how many are
// taken. Throws Error(kInput).
std::vector<std::pair<std::string, EnvMap>> load_scene_maps(const std::filesystem::path& folder,
                                                            const std::vector<std::string>& scenes, SceneKind kind);

}  // namespace faceprobe::cli

#pragma once
// Internal: a glTF document's members, checked, and its tree of nodes.

#include "assets/model_checks.h"

#include <nlohmann/json.hpp>

namespace faceprobe::assets {

[[noreturn]] void refuse_gltf(const ModelFile& file, const std::string& what);
// Null when the object has no such member, or is none.
nlohmann::json gltf_member(const nlohmann::json& object, const char* key);
// An empty list when there is none; at most max_parts of objects.
const nlohmann::json& gltf_list(const ModelFile& file, const nlohmann::json& object, const char* key);
// A whole number from 0 to 2^40.
std::int64_t gltf_whole(const ModelFile& file, const nlohmann::json& object, const char* key, std::int64_t fallback);
bool gltf_numbers(const nlohmann::json& value, std::size_t count);
// Each sentence once.
void gltf_warn(std::vector<std::string>& warnings, const std::string& sentence);

// Nodes and scenes to `out`, whose meshes are there already. Refuses what is no tree, and too deep a one: assimp follows
// children by recursion.
void copy_nodes(const ModelFile& file, const nlohmann::json& source, nlohmann::json& out);

}  // namespace faceprobe::assets

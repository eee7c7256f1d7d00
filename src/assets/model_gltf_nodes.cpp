#include "assets/model_gltf_nodes.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::assets {

using nlohmann::json;

namespace {

constexpr int kMaxNodeDepth = 200;

// The indices of a list of nodes.
std::vector<std::size_t> node_indices(const ModelFile& file, const json& object, const char* key, std::size_t count) {
  std::vector<std::size_t> indices;
  for (const json& value : gltf_list(file, object, key)) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
      refuse_gltf(file,
                  "it names node " + value.dump() + ", and there are " + std::to_string(count) + ", counted from 0");
    indices.push_back(value.get<std::size_t>());
  }
  return indices;
}

}  // namespace

void refuse_gltf(const ModelFile& file, const std::string& what) {
  file.refuse("is not a glTF that can be read: " + what + ". Export it again.");
}

json gltf_member(const json& object, const char* key) {
  return object.is_object() ? object.value(key, json()) : json();
}

const json& gltf_list(const ModelFile& file, const json& object, const char* key) {
  static const json kEmpty = json::array();
  if (!object.is_object() || !object.contains(key)) return kEmpty;
  const json& found = object[key];
  if (!found.is_array()) refuse_gltf(file, std::string(key) + " is no list");
  file.check_count(static_cast<std::int64_t>(found.size()), file.limits.max_parts, key);
  return found;
}

std::int64_t gltf_whole(const ModelFile& file, const json& object, const char* key, std::int64_t fallback) {
  if (!object.is_object()) refuse_gltf(file, "something that should be an object has no " + std::string(key));
  if (!object.contains(key)) return fallback;
  const json& value = object[key];
  constexpr double kLargest = 1LL << 40;
  if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= kLargest) ||
      (value.is_number_float() && value.get<double>() != std::floor(value.get<double>()))) {
    refuse_gltf(file, std::string(key) + " is " + value.dump().substr(0, 40) + ", and a whole number is needed");
  }
  return static_cast<std::int64_t>(value.get<double>());
}

bool gltf_numbers(const json& value, std::size_t count) {
  return value.is_array() && value.size() == count &&
         std::ranges::all_of(value, [](const json& entry) { return entry.is_number(); });
}

void gltf_warn(std::vector<std::string>& warnings, const std::string& sentence) {
  if (std::ranges::find(warnings, sentence) == warnings.end()) warnings.push_back(sentence);
}

void copy_nodes(const ModelFile& file, const json& source, json& out) {
  const json& nodes = gltf_list(file, source, "nodes");
  const std::size_t meshes = out.contains("meshes") ? out["meshes"].size() : 0;
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> parent(nodes.size(), kNone);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    json copy = json::object();
    if (const json name = gltf_member(nodes[i], "name"); name.is_string()) copy["name"] = name;
    if (const std::int64_t mesh = gltf_whole(file, nodes[i], "mesh", -1); mesh >= 0) {
      if (mesh >= static_cast<std::int64_t>(meshes))
        refuse_gltf(file, "mesh " + std::to_string(mesh) + " is not among its meshes");
      copy["mesh"] = mesh;
    }
    for (const auto& [key, count] : {std::pair{"matrix", 16U}, {"translation", 3U}, {"rotation", 4U}, {"scale", 3U}}) {
      if (const json value = gltf_member(nodes[i], key); gltf_numbers(value, count)) copy[key] = value;
    }
    for (const std::size_t child : node_indices(file, nodes[i], "children", nodes.size())) {
      if (parent[child] != kNone) refuse_gltf(file, "node " + std::to_string(child) + " has two parents");
      parent[child] = i;
      copy["children"].push_back(child);
    }
    out["nodes"].push_back(copy);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    int depth = 0;
    for (std::size_t at = i; at != kNone; at = parent[at]) {
      if (++depth > kMaxNodeDepth)
        refuse_gltf(file, "its nodes are nested more than " + std::to_string(kMaxNodeDepth) + " deep, or in a circle");
    }
  }
  const json& scenes = gltf_list(file, source, "scenes");
  const auto scene = static_cast<std::size_t>(gltf_whole(file, source, "scene", 0));
  if (scene >= scenes.size()) refuse_gltf(file, "it has no scene " + std::to_string(scene));
  json roots = json::array();
  std::vector<bool> seen(nodes.size(), false);
  for (const std::size_t root : node_indices(file, scenes[scene], "nodes", nodes.size())) {
    if (seen[root] || parent[root] != kNone)
      refuse_gltf(file, "node " + std::to_string(root) + " is twice in the scene");
    seen[root] = true;
    roots.push_back(root);
  }
  out["scenes"] = json::array({{{"nodes", roots}}});
  out["scene"] = 0;
}

}  // namespace faceprobe::assets

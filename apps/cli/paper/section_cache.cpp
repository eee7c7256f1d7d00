#include "paper/section_cache.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "paper/folder_listing.h"
#include "torch_side.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;

std::string hash_of_file(const fs::path& file) { return io::sha256_of_file(file, kMostBytes); }

// The pictures themselves follow from the recipe and the names of what they were made of, which the index holds with every shard's size.
std::string hash_of_faces(const fs::path& folder) {
  std::string text;
  for (const char* name : {"index.json", "recipe.json"}) {
    if (fs::exists(folder / name)) text += hash_of_file(folder / name);
  }
  return text;
}

std::optional<Sections> read_sections(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  const nlohmann::json json = nlohmann::json::parse(io::read_text(file, kMostBytes), nullptr, false);
  if (!json.is_array()) return std::nullopt;
  Sections sections;
  try {
    for (const nlohmann::json& section : json) sections.push_back(eval::section_from_json(section.get<std::string>()));
  } catch (const std::exception&) {
    return std::nullopt;  // of another version: measured again
  }
  return sections;
}

}  // namespace

std::string identity_of_data(const PaperPlan& plan) {
  std::string text;
  for (const fs::path& folder : {plan.faces, plan.light, plan.groups, plan.distant, plan.training})
    text += folder.empty() ? "none" : hash_of_faces(folder) + listing_of(folder);
  for (const char* part : {"real", "hdri/dev", "objects"}) text += part + listing_of(plan.data / part);
  if (fs::exists(plan.data / "hdri" / "dev.csv")) text += hash_of_file(plan.data / "hdri" / "dev.csv");
  return io::sha256_hex(text);
}

std::string key_of(const PaperPlan& plan, const std::string& data, std::span<const char* const> rivals,
                   const std::string& programs) {
  std::string text = hash_of_file("/proc/self/exe") + hash_of_file(torch_side_file());
  for (const char* name : {"face.safetensors", "light.safetensors"}) text += hash_of_file(io::data_file(name));
  text += data;
  for (const char* rival : rivals) {
    const fs::path file = plan.rivals / rival;
    text += rival + (!plan.rivals.empty() && fs::exists(file) ? hash_of_file(file) : "none");
  }
  text += programs;
  text += plan.quick ? "quick" : "whole";
  return io::sha256_hex(text);
}

Sections cached_part(const PaperPlan& plan, const std::string& key, const std::string& name,
                     const std::function<Sections(const PaperPlan&)>& measure) {
  constexpr std::size_t kKeyLetters = 16;
  const fs::path folder = plan.output / "cache";
  const fs::path file = folder / (name + "-" + key.substr(0, kKeyLetters) + ".json");
  if (std::optional<Sections> known = read_sections(file)) return *std::move(known);
  Sections sections = measure(plan);
  nlohmann::json json = nlohmann::json::array();
  for (const eval::ReportSection& section : sections) json.push_back(eval::section_json(section));
  io::create_folder(folder);
  io::write_file_atomically(file, json.dump());
  return sections;
}

}  // namespace faceprobe::cli

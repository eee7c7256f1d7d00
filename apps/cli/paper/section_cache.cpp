#include "paper/section_cache.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;

std::string hash_of_file(const fs::path& file) {
  const std::vector<std::byte> bytes = io::read_file(file, kMostBytes);
  return io::sha256_hex(bytes.data(), bytes.size());
}

std::string hash_of_text(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return io::sha256_hex(bytes.data(), bytes.size());
}

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
  const std::vector<std::byte> bytes = io::read_file(file, kMostBytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
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

std::string key_of(const PaperPlan& plan) {
  std::string text = hash_of_file("/proc/self/exe");
  for (const char* name : {"face.safetensors", "light.safetensors"}) text += hash_of_file(io::data_file(name));
  for (const fs::path& folder : {plan.faces, plan.light, plan.groups, plan.training}) {
    text += folder.empty() ? "none" : hash_of_faces(folder);
  }
  if (!plan.rivals.empty() && fs::is_directory(plan.rivals)) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(plan.rivals)) {
      if (entry.path().extension() == ".safetensors") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) text += file.filename().string() + hash_of_file(file);
  }
  text += plan.quick ? "quick" : "whole";
  return hash_of_text(text);
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

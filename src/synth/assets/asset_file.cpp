#include "faceprobe/synth/asset_file.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/tensor_file.h"
#include "synth/assets/asset_head.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr const char* kKey = "faceprobe_assets";  // of the metadata: names, and what the arrays do not say
constexpr int kFormat = 1;
constexpr float kLargestHalf = 65504.0F;
constexpr std::int64_t kStatisticNumbers = 5;

std::string skin_name(std::size_t i) { return "skin." + std::to_string(i); }
std::string map_name(std::size_t i) { return "map." + std::to_string(i); }
std::string head_prefix(std::size_t i) { return "head." + std::to_string(i) + "."; }

// The exponent of two that brings the map's brightest value just under the largest float16, so that a sun stays as bright as it is and the
// dark is as fine as can be.
int scale_of(const std::string& name, const EnvMap& map) {
  float largest = 0;
  for (const float value : map.radiance().values()) {
    if (!std::isfinite(value) || value < 0) {
      throw Error(
          ExitCode::kInput,
          "The map " + name + " holds a value that is negative or not finite. Repair the texel from its neighbours.");
    }
    largest = std::max(largest, value);
  }
  return largest > 0 ? static_cast<int>(std::floor(std::log2(kLargestHalf / largest))) : 0;
}

nlohmann::json put_map(const std::string& name, const EnvMap& map, std::size_t number, io::TensorFileBuilder& file) {
  const int scale = scale_of(name, map);
  Image scaled = map.radiance();
  for (float& value : scaled.values()) value = std::ldexp(value, scale);
  io::to_half(scaled.values(), file.add<io::Half>(map_name(number), {map.height(), map.width(), 3}));
  return {{"name", name}, {"scale", scale}};
}

EnvMap map_from(const io::MappedTensors& file, std::size_t number, int scale) {
  const std::span<const io::Half> from = file.values<io::Half>(map_name(number), {-1, -1, 3});
  const std::vector<std::int64_t>& shape = file.shape(map_name(number));
  Image radiance(static_cast<int>(shape[1]), static_cast<int>(shape[0]), 3);
  io::to_float(from, radiance.values());
  for (float& value : radiance.values()) value = std::ldexp(value, -scale);
  return EnvMap(std::move(radiance));
}

void put_statistics(const SkinStatistics& statistics, io::TensorFileBuilder& file) {
  const std::span<float> to =
      file.add<float>("reflectance", {static_cast<std::int64_t>(statistics.regions.size()), kStatisticNumbers});
  std::size_t at = 0;
  for (const SkinStatistics::Value& value : statistics.regions) {
    for (const float number : {value.roughness, value.roughness_deviation, value.specular_albedo,
                               value.specular_albedo_deviation, value.measured ? 1.0F : 0.0F}) {
      to[at++] = number;
    }
  }
}

SkinStatistics statistics_from(const io::MappedTensors& file) {
  SkinStatistics statistics;
  const std::span<const float> from =
      file.values<float>("reflectance", {static_cast<std::int64_t>(statistics.regions.size()), kStatisticNumbers});
  for (std::size_t i = 0; i < statistics.regions.size(); ++i) {
    const float* row = from.data() + i * kStatisticNumbers;
    statistics.regions[i] = {row[0], row[1], row[2], row[3], row[4] > 0};
  }
  return statistics;
}

void require_valid(const HeadModel& model, const std::string& name) {
  if (const std::string problem = model.validate(); !problem.empty())
    throw Error(ExitCode::kInput, "Head model " + model.name + " of " + name + ": " + problem);
}

AssetSources sources_from(const io::MappedTensors& file, const nlohmann::json& about) {
  AssetSources sources;
  for (std::size_t i = 0; i < about.at("heads").size(); ++i)
    sources.heads.push_back(head_from(file, head_prefix(i), about.at("heads")[i]));
  for (std::size_t i = 0; i < about.at("skins").size(); ++i) {
    const std::span<const std::uint8_t> bytes = file.values<std::uint8_t>(skin_name(i), {-1, -1, 3});
    const std::vector<std::int64_t>& shape = file.shape(skin_name(i));
    ByteImage skin(static_cast<int>(shape[1]), static_cast<int>(shape[0]), 3);
    std::ranges::copy(bytes, skin.data());
    sources.skins.emplace_back(about.at("skins")[i].get<std::string>(), std::move(skin));
  }
  for (std::size_t i = 0; i < about.at("maps").size(); ++i) {
    const nlohmann::json& map = about.at("maps")[i];
    sources.maps.emplace_back(map.at("name").get<std::string>(), map_from(file, i, map.at("scale").get<int>()));
  }
  if (file.has("reflectance")) sources.reflectance = statistics_from(file);
  return sources;
}

}  // namespace

void write_asset_file(const std::filesystem::path& path, const AssetSources& sources) {
  io::TensorFileBuilder file;
  nlohmann::json about = {{"format", kFormat},
                          {"heads", nlohmann::json::array()},
                          {"skins", nlohmann::json::array()},
                          {"maps", nlohmann::json::array()}};
  for (std::size_t i = 0; i < sources.heads.size(); ++i) {
    require_valid(sources.heads[i], path.string());
    about["heads"].push_back(put_head(sources.heads[i], head_prefix(i), file));
  }
  for (std::size_t i = 0; i < sources.skins.size(); ++i) {
    const auto& [name, skin] = sources.skins[i];
    if (skin.channels() != 3) throw std::invalid_argument("A skin has three channels.");
    std::ranges::copy(skin.values(), file.add<std::uint8_t>(skin_name(i), {skin.height(), skin.width(), 3}).begin());
    about["skins"].push_back(name);
  }
  for (std::size_t i = 0; i < sources.maps.size(); ++i)
    about["maps"].push_back(put_map(sources.maps[i].first, sources.maps[i].second, i, file));
  if (sources.reflectance) put_statistics(*sources.reflectance, file);
  file.set_metadata(kKey, about.dump());
  file.write(path);
}

AssetSources read_asset_file(const std::filesystem::path& path) {
  const io::MappedTensors file(path);
  const auto text = file.metadata().find(kKey);
  if (text == file.metadata().end()) {
    throw Error(ExitCode::kInput,
                path.string() + " holds no heads, skins or maps; name a file that `faceprobe synth pack` wrote.");
  }
  try {
    const nlohmann::json about = nlohmann::json::parse(text->second);
    if (about.at("format").get<int>() != kFormat) {
      throw Error(ExitCode::kInput,
                  path.string() + " is of another version of faceprobe; write it anew with `faceprobe synth pack`.");
    }
    AssetSources sources = sources_from(file, about);
    for (const HeadModel& model : sources.heads) require_valid(model, path.string());
    return sources;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& fault) {  // the JSON's, and what an EnvMap or a list of numbers refuses
    throw Error(ExitCode::kInput,
                path.string() + " is damaged (" + fault.what() + "); write it anew with `faceprobe synth pack`.");
  }
}

}  // namespace faceprobe::synth

#include "train_sky_command.h"

#include "faceprobe/assets/maps.h"
#include "faceprobe/core/error.h"
#include "faceprobe/train/train_sky.h"
#include "scene_table.h"

#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

namespace faceprobe::cli {
namespace {

// The maps' names as scene_of_maps() takes them.
std::string names_of(const std::vector<train::NamedMap>& maps) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& [name, map] : maps) names.push_back(name);
  return nlohmann::json{{"maps", names}}.dump();
}

std::vector<train::NamedMap> outdoor_maps(const std::filesystem::path& folder, const std::vector<std::string>& scenes) {
  std::vector<train::NamedMap> maps;
  if (folder.empty()) return maps;
  maps = assets::load_maps(folder);
  if (scenes.empty()) return maps;
  const std::string names = names_of(maps);
  std::vector<char> wanted(maps.size(), 0);
  for (const std::string& table : scenes) {
    const auto folder_of = scene_of_maps(table, names);
    const auto scene_of = scene_of_maps(table, names, "scene");
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const int map = static_cast<int>(i);
      if (folder_of(map) == "outdoor" && scene_of(map) != "night") wanted[i] = 1;
    }
  }
  std::vector<train::NamedMap> outdoor;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (wanted[i] != 0) outdoor.push_back(std::move(maps[i]));
  }
  spdlog::info("{} of the {} maps in {} are outdoor and by day", outdoor.size(), maps.size(), folder.string());
  return outdoor;
}

}  // namespace

int train_sky(const train::TrainRun& options, const std::string& config, const std::vector<std::string>& scenes) {
  if (!options.start.empty() || options.repeat_batch) {
    throw Error(ExitCode::kUsage,
                "The sky regressor is trained from the start in minutes; --start and --repeat-batch are for the other "
                "networks.");
  }
  train::SkyRun run;
  if (!config.empty()) run.config = train::sky_config_from_json(config);
  run.maps = outdoor_maps(options.data, scenes);
  run.validation_maps = outdoor_maps(options.validation_data, scenes);
  run.folder = options.folder;
  run.threads = options.threads;
  const train::SkyReport report = train::train_sky(run, [](const train::SkyRow& row, int epochs) {
    spdlog::info("epoch {} of {}: sun {:.3f}, numbers {:.3f}; validation {:.3f}, {:.3f}, sun off by {:.1f} degrees",
                 row.epoch, epochs, row.training.sun, row.training.numbers, row.validation.sun, row.validation.numbers,
                 row.validation.median_deg);
  });
  if (!run.validation_maps.empty()) {
    spdlog::info("median error of the sun {:.1f} degrees, {:.0f} % within 45; by guessing the mean {:.1f}, {:.0f} %",
                 report.validation.median_deg, 100 * report.validation.within_45, report.guess.median_deg,
                 100 * report.guess.within_45);
  }
  spdlog::info("wrote {}", report.weights.string());
  return 0;
}

}  // namespace faceprobe::cli

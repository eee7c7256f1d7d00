#include "train_regressor_command.h"

#include "faceprobe/core/error.h"
#include "scene_maps.h"
#include "torch_side.h"

#include <spdlog/spdlog.h>

namespace faceprobe::cli {
namespace {

train::RegressorRun regressor_run(const train::TrainRun& options, const std::string& config,
                                  const train::RegressorConfig& usual) {
  if (!options.start.empty() || options.repeat_batch) {
    throw Error(ExitCode::kUsage,
                "What regresses light is trained from the start in minutes; --start and --repeat-batch are for the "
                "other networks.");
  }
  return {.config = config.empty() ? usual : train::regressor_config_from_json(config, usual),
          .folder = options.folder,
          .threads = options.threads};
}

// Gardner's network is one for rooms.
std::vector<EnvMap> indoor_maps(const std::filesystem::path& folder, const std::vector<std::string>& scenes) {
  std::vector<EnvMap> maps;
  for (auto& [name, map] : load_scene_maps(folder, scenes, SceneKind::kIndoor)) maps.push_back(std::move(map));
  return maps;
}

std::string errors_text(const train::RegressorErrors& errors) {
  return fmt::format("diffuse {:.4f}, rough {:.3f}, direction {:.1f} degrees, level {:.3f}", errors.diffuse,
                     errors.rough, errors.direction_deg, errors.level);
}

void log_regressor_row(const train::RegressorRow& row, int epochs) {
  spdlog::info("epoch {} of {}: loss {:.4f}; {}", row.epoch, epochs, row.loss, errors_text(row.validation));
}

int finish(const train::RegressorReport& report) {
  spdlog::info("the training lights' mean, whatever the picture: {}", errors_text(report.usual));
  spdlog::info("wrote {}", report.weights.string());
  return 0;
}

}  // namespace

int train_gardner(const train::TrainRun& options, const std::string& config, const std::vector<std::string>& scenes) {
  const train::RegressorRun run = regressor_run(options, config, train::gardner_config());
  const train::GardnerData data{.training = indoor_maps(options.data, scenes),
                                .validation = indoor_maps(options.validation_data, scenes)};
  return finish(torch_side().train_gardner(data, run, log_regressor_row));
}

int train_legendre(const train::TrainRun& options, const std::string& config) {
  const train::RegressorRun run = regressor_run(options, config, train::legendre_config());
  const train::LegendreData data{.training = options.data, .validation = options.validation_data};
  return finish(torch_side().train_legendre(data, run, log_regressor_row));
}

}  // namespace faceprobe::cli

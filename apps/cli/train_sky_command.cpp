#include "train_sky_command.h"

#include "faceprobe/core/error.h"
#include "scene_maps.h"
#include "torch_side.h"

#include <spdlog/spdlog.h>

namespace faceprobe::cli {

int train_sky(const train::TrainRun& options, const std::string& config, const std::vector<std::string>& scenes) {
  if (!options.start.empty() || options.repeat_batch) {
    throw Error(ExitCode::kUsage,
                "The sky regressor is trained from the start in minutes; --start and --repeat-batch are for the other "
                "networks.");
  }
  train::SkyRun run;
  if (!config.empty()) run.config = train::sky_config_from_json(config);
  run.maps = load_scene_maps(options.data, scenes, SceneKind::kOutdoorByDay);
  run.validation_maps = load_scene_maps(options.validation_data, scenes, SceneKind::kOutdoorByDay);
  run.folder = options.folder;
  run.threads = options.threads;
  const train::SkyReport report = torch_side().train_sky(run, [](const train::SkyRow& row, int epochs) {
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

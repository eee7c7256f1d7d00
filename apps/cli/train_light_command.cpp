#include "train_light_command.h"

#include "faceprobe/core/error.h"
#include "torch_side.h"

#include <spdlog/spdlog.h>

namespace faceprobe::cli {

int train_light(const train::TrainRun& options, const std::string& config) {
  if (!options.start.empty() || options.repeat_batch) {
    throw Error(ExitCode::kUsage,
                "The light prior is trained from the start in minutes; --start and --repeat-batch are for the other "
                "networks.");
  }
  train::LightRun run;
  if (!config.empty()) run.config = train::light_config_from_json(config);
  run.data = options.data;
  run.more_data = options.more_data;
  run.validation_data = options.validation_data;
  run.folder = options.folder;
  run.threads = options.threads;
  const train::LightReport report = torch_side().train_light(run, [](const train::LightRow& row, int epochs) {
    spdlog::info("epoch {} of {}: diffuse {:.4f}, shape {:.4f}, glossy {:.3f}; validation {:.4f}, {:.4f}, {:.3f}",
                 row.epoch, epochs, row.training.diffuse, row.training.shape, row.training.glossy,
                 row.validation.diffuse, row.validation.shape, row.validation.glossy);
  });
  spdlog::info("wrote {}", report.weights.string());
  return 0;
}

}  // namespace faceprobe::cli

#pragma once
// Trains the sky regressor (net/sky_regressor.h) on outdoor environment maps, after Hold-Geoffroy et al. 2017: a clear sky is fitted to each map
// (lighting/sky.h), parts of the map are what a camera in it would photograph, and a small network learns the fit's numbers from such a part. Minutes
// on two cores.
//
//   train::SkyRun run;
//   run.maps = outdoor_maps;  run.validation_maps = other_maps;  run.folder = "runs/sky";
//   const train::SkyReport report = train::train_sky(run);
//   std::cout << report.validation.median_deg << " degrees, by guessing " << report.guess.median_deg << '\n';
//
// The same config and maps give the same weights on the same machine. It is too short to be worth resuming.

#include "faceprobe/core/env_map.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::train {

struct SkyConfig {
  int px = 96;                                             // side of a crop
  std::vector<int> widths = {24, 40, 64, 64, 96, 96, 96};  // channels after each convolution
  int hidden = 256;                                        // units of the layer between them and the heads
  int crops_per_map = 64;                                  // drawn once, also of the maps to validate on
  int batch = 32;
  int epochs = 20;
  double learning_rate = 2e-3;  // AdamW's at its peak; half a cosine down to 0
  double weight_decay = 0.02;   // AdamW's
  double drop = 0.3;            // share of hidden units left out in each step
  double numbers_weight = 0.3;  // of the numbers' squared error, in units of their spread, against the sun's divergence
  double sun_concentration = 40;  // of the true sun over the bins: exp(it * cosine), von Mises and Fisher's
  double least_view_deg = 45;     // field of view
  double most_view_deg = 85;
  double most_pitch_deg = 15;     // of the camera up or down
  double exposure_spread = 0.25;  // deviation of the logarithm of a crop's exposure
  double colour_spread = 0.06;    // of that of a channel's gain, drawn in each step
  std::uint64_t seed = 1;

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};
// Throws Error(kUsage): not JSON, a key that does not exist, a value of another type or out of range.
SkyConfig sky_config_from_json(const std::string& text);
std::string to_json(const SkyConfig& config);

// Over crops.
struct SkyErrors {
  double sun = 0;         // mean divergence of the bins
  double numbers = 0;     // mean squared error of the standardised numbers
  double median_deg = 0;  // of the angle between the sun and where it was found, to 180
  double within_45 = 0;   // share of crops in which that is 45 degrees or less
};

struct SkyRow {
  int epoch = 0;
  SkyErrors training;    // with what is left out by chance; its angles are 0
  SkyErrors validation;  // 0 without such maps
};

using NamedMap = std::pair<std::string, EnvMap>;

struct SkyRun {
  SkyConfig config;
  std::vector<NamedMap> maps;             // outdoor, by day, +y up
  std::vector<NamedMap> validation_maps;  // of other places; none: nothing is measured
  std::filesystem::path folder;           // made; gets weights.safetensors, log.csv, config.json
  int threads = 0;
};

struct SkyReport {
  std::vector<SkyRow> rows;
  SkyErrors validation;  // of the last epoch
  SkyErrors guess;       // on the validation maps by always guessing the mean of the training's suns; angles alone
  std::filesystem::path weights;
};

// Throws Error: no maps, or one without light above its horizon (kInput), a folder that cannot be written (kOutput), a config that does not
// validate (kUsage).
SkyReport train_sky(const SkyRun& run, const std::function<void(const SkyRow&, int epochs)>& progress = {});

}  // namespace faceprobe::train

#pragma once
// Trains the two rivals of net/light_regressor.h, which regress light straight from a picture. Both are built after what is published of them,
// small, and learn from little: minutes on two cores, to have something to measure against. Nothing that makes light should use them.
//
//   train::RegressorRun run{.config = train::gardner_config(), .folder = "runs/gardner"};
//   const train::RegressorReport report = train::train_gardner({.training = maps, .validation = other_maps}, run);
//
//   run = {.config = train::legendre_config(), .folder = "runs/legendre"};
//   train::train_legendre({.training = "faces/train", .validation = "faces/dev"}, run);
//
// The same config and data give the same weights on the same machine, with the same number of threads. It is too short to be worth resuming.

#include "faceprobe/core/env_map.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::train {

struct RegressorConfig {
  int picture_px = 96;                             // side of what the network sees
  std::vector<int> widths = {16, 32, 48, 64, 96};  // of its encoder, each at half the size of the last
  int features = 160;                              // what that makes of a picture
  int light_size = 32;                             // Gardner's: height of the panorama; LeGendre's: nside of the grid
  int examples = 4000;  // Gardner's: crops of all maps together; LeGendre's: faces at most, spread over the data
  int batch = 32;
  int epochs = 12;
  double learning_rate = 2e-3;  // AdamW's at its peak; half a cosine down to 0
  double weight_decay = 0.03;   // AdamW's
  double average_decay = 0.99;  // of the running average of the weights, which is what is kept
  double drop = 0.3;            // share of the features left out in each step
  double colour_jitter =
      0.1;  // deviation of the logarithm of each channel's gain, by which picture and light are changed
  // Gardner's alone. First where lights are is learnt, as a mask seen through a lobe that narrows, then how bright they are.
  double mask_share = 0.4;        // of the epochs
  double largest_exponent = 30;   // of the lobe's cosine, which begins at 1
  double mask_weight = 1;         // against the colours' error
  double intensity_weight = 0.3;  // the same
  // LeGendre's alone: of the balls' pictures, against the diffuse ball's.
  double rough_weight = 0.6;
  double mirror_weight = 0.1;  // the same
  std::uint64_t seed = 1;

  // Empty when usable, else a sentence that says which value is wrong. What only the network knows it says itself (kUsage).
  std::string validate() const;
};
RegressorConfig gardner_config();   // what its network is trained with where nothing else is said
RegressorConfig legendre_config();  // the same
// What the text does not name stays as in `usual`. Throws Error(kUsage): not JSON, a key that does not exist, a value of another type or out
// of range.
RegressorConfig regressor_config_from_json(const std::string& text, const RegressorConfig& usual);
std::string to_json(const RegressorConfig& config);

// Means over examples; found and true light each over its own level, the mean of a white ball's front under it.
struct RegressorErrors {
  double diffuse = 0;  // root mean square error of a white ball's front over its brightest point
  double rough = 0;    // mean absolute error of the logarithm of the light seen in a rough mirror ball, all around
  double direction_deg = 0;  // between the directions that the light comes from as a whole
  double level = 0;          // mean absolute error of the level's logarithm; how bright the light is beside the picture
};

struct RegressorRow {
  int epoch = 0;
  double loss = 0;  // with what is left out by chance; of another kind in the epochs that learn Gardner's mask
  RegressorErrors validation;  // of the running average; 0 without such data
};

struct RegressorRun {
  RegressorConfig config;
  std::filesystem::path folder;  // made; gets weights.safetensors, log.csv, config.json
  int threads = 0;
};

struct RegressorReport {
  std::vector<RegressorRow> rows;
  RegressorErrors usual;  // on the validation data, of the mean of all training lights, whatever the picture
  std::filesystem::path weights;
};

// Maps as the world has them: +y up.
struct GardnerData {
  std::vector<EnvMap> training;    // in the world's frame
  std::vector<EnvMap> validation;  // empty: no validation
};

// Folders that `faceprobe synth` wrote. A face is found by its mesh where `faceprobe mesh` has been there, else by its landmarks.
struct LegendreData {
  std::filesystem::path training;
  std::filesystem::path validation;  // empty: no validation
};

using RegressorProgress = std::function<void(const RegressorRow&, int epochs)>;

// Both throw Error: nothing to learn from (kInput), a folder that cannot be written (kOutput), a config that does not validate (kUsage).
RegressorReport train_gardner(const GardnerData& data, const RegressorRun& run, const RegressorProgress& progress = {});
RegressorReport train_legendre(const LegendreData& data, const RegressorRun& run,
                               const RegressorProgress& progress = {});

}  // namespace faceprobe::train

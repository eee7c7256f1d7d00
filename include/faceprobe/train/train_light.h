#pragma once
// Trains the light prior (net/light_prior.h) on what estimates read from synthetic photos (synth/traced.h): a small network of plain layers, a
// few minutes on two cores. The loss is what the light is for: the picture of a ball under it, diffuse and glossy.
//
//   train::LightRun run;
//   run.data = "faces/train";  run.validation_data = "faces/dev";  run.folder = "runs/light";
//   const train::LightReport report = train::train_light(run);
//
// The same config and data give the same weights on the same machine. It is too short to be worth resuming.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::train {

struct LightConfig {
  std::vector<int> hidden = {384, 384};  // units of the layers between
  int batch = 128;
  int epochs = 60;
  double learning_rate = 1.5e-3;  // AdamW's at its peak; half a cosine down to 0
  double weight_decay = 1e-3;     // AdamW's
  double average_decay = 0.99;    // of the running average of the weights, which is what is kept
  double drop = 0.2;              // share of hidden units left out in each step
  double input_drop = 0.1;        // of inputs
  double input_noise = 0.1;       // of standardised inputs
  double grey_share = 0.05;       // of examples without colour
  double lobe_weight = 0.15;      // of the glossy ball's error against the diffuse ball's
  double shape_weight = 0;        // of the diffuse ball's where each picture is over its own brightest point
  std::uint64_t seed = 1;

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};
// Throws Error(kUsage): not JSON, a key that does not exist, a value of another type or out of range.
LightConfig light_config_from_json(const std::string& text);
std::string to_json(const LightConfig& config);

// Means over examples.
struct LightErrors {
  double diffuse = 0;  // root mean square error of a white ball's front over its brightest point
  // The same of each picture over its own brightest point: no level counts, as in the relighting benchmark.
  double shape = 0;
  double glossy = 0;  // mean absolute error of the logarithm of the light seen in a rough mirror ball, all around
};

struct LightRow {
  int epoch = 0;
  LightErrors training;    // with what is left out by chance
  LightErrors validation;  // of the running average; 0 without such data
};

struct LightRun {
  LightConfig config;
  std::filesystem::path data;                    // folder with traced photos
  std::vector<std::filesystem::path> more_data;  // more of them, in the order in which they are learnt from
  std::filesystem::path validation_data;         // empty: no validation
  std::filesystem::path folder;                  // made; gets weights.safetensors, log.csv, config.json
  int threads = 0;
};

struct LightReport {
  std::vector<LightRow> rows;
  std::filesystem::path weights;
};

// Throws Error: no traced photos (kInput), a folder that cannot be written (kOutput), a config that does not validate (kUsage).
LightReport train_light(const LightRun& run, const std::function<void(const LightRow&, int epochs)>& progress = {});

}  // namespace faceprobe::train

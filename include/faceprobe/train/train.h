#pragma once
// Trains the highlight network, or the face network (config's architecture "face", data with meshes), on a folder of synthetic faces
// (synth/shard.h): paper Section 3.1, with the loss, network and augmentation of the config. The run's folder holds everything: the
// config, a checkpoint from which the run goes on bit for bit, one CSV, pictures, and the weights as they are at the last save.
//
//   train::TrainRun run;
//   run.config = train::train_config_from_json(text);
//   run.data = "faces/train";  run.validation_data = "faces/dev";  run.folder = "runs/highlight";
//   const train::TrainReport report = train::train_highlight(run, {});
//
// Not for real photos: see finetune.h.

#include "faceprobe/core/image.h"
#include "faceprobe/net/device.h"
#include "faceprobe/train/config.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::train {

struct TrainRun {
  TrainConfig config;
  std::filesystem::path data;
  std::vector<std::filesystem::path> more_data;  // further such folders, learnt from as well
  std::filesystem::path validation_data;         // empty: no validation
  std::filesystem::path folder;  // made; a run that is there goes on if its config and data are the same
  std::filesystem::path start;   // weights to begin with, of a network nowhere wider; empty: drawn from the seed
  net::Device device;
  int threads = 0;  // of the processor; 0 = all
  // Threads beside those that make batches ready; 0 = what the device can use up. The run is the same with any number.
  int workers = 0;
  // Ends the run as if its config had so many steps, but with the learning rate as it is there; 0 = at the config's last step. A folder
  // that holds more steps than that is refused; without it the run goes on later.
  std::int64_t stop_after = 0;
  bool repeat_batch = false;  // train on the first batch only: the speed that data must not hold up. Saves nothing
};

// Errors of the highlight layer on the 0-255 scale, means over pictures of the root mean square (paper, Table 1).
struct Validation {
  double skin = 0;         // on the face's skin
  double whole = 0;        // on the whole picture
  double black_skin = 0;   // what an empty layer would have
  double black_whole = 0;  // the same of the whole picture
  // Of the face network; 0 for the others. albedo_shading has `shading` and `colour_deg` alone, and none of the above.
  double normal_deg = 0;    // mean angle between normals on the face's skin
  double region_share = 0;  // of pixels whose region is right
  double shading = 0;       // root mean square error of the shading's logarithm on skin, its level apart
  double colour_deg = 0;    // mean angle between the light's colours on skin
  double open_shading = 0;  // as `shading`, of what would be there if nothing stood in the light's way; of face alone
};

struct TrainRow {
  std::int64_t step = 0;     // steps done
  double loss = 0;           // mean since the last row
  double learning_rate = 0;  // at that step
  double samples_per_second = 0;
  bool validated = false;
  Validation validation;
};

struct TrainProgress {
  TrainRow row;
  std::int64_t steps = 0;   // at the end
  double seconds_left = 0;  // at the present rate
};

struct TrainReport {
  std::vector<TrainRow> rows;  // of the whole run, resumed parts included
  bool finished = false;       // to the last step, or to stop_after; false: it was stopped before
  std::filesystem::path weights;
  double samples_per_second = 0;  // over this part of the run, validation apart
};

struct TrainHooks {
  std::function<void(const TrainProgress&)> progress;  // at each row
  std::function<bool()> stop;  // asked at each step; true ends the run, which goes on from its last save
  // Writes a picture into the run's folder; without it none are made.
  std::function<void(const std::filesystem::path&, const ByteImage&)> write_picture;
};

// Throws Error: data that cannot be read or lack the meshes the network wants (kInput), a folder of another run or that cannot be
// written (kOutput), a device that is not there (kDevice), a config that does not validate (kUsage), a stop_after that is past (kUsage), a loss that is no number any more
// (kUnexpected; the checkpoint before it is kept).
TrainReport train_highlight(const TrainRun& run, const TrainHooks& hooks);

// "step,loss,..." with one line a row.
std::string to_csv(const std::vector<TrainRow>& rows);

// 960 x 840 x 3, sRGB: above the loss (logarithmic) over the steps, below the validation errors on skin (red) and whole pictures (blue).
ByteImage draw_curves(const std::vector<TrainRow>& rows);

}  // namespace faceprobe::train

#pragma once
// Finetunes the highlights of a network ("unet", "face", or the paper's "mscr") on photos of people, without labels: paper Section 3.2. One person's skin has
// the same chromaticity in every photo, so what the diffuse layers of several photos do not share is highlight that was missed, or skin
// that was taken. Every step also trains on synthetic faces, so that the network keeps what it knows. The run's folder holds everything, as
// that of train.h does: the same run goes on bit for bit after a stop.
//
//   train::FinetuneRun run;
//   run.config = train::finetune_config_from_json(text);        // models/finetune.json
//   run.people = train::load_people("real/finetune", {});       // one folder a person
//   run.start = "models/face.safetensors";  run.synthetic = "faces/train";  run.validation = "faces/dev";  run.folder = "runs/finetuned";
//   const train::FinetuneReport report = train::finetune_highlight(run, {});
//
// Weights inherit the terms of the photos they have seen.

#include "faceprobe/core/image.h"
#include "faceprobe/net/device.h"
#include "faceprobe/train/people.h"
#include "faceprobe/train/train.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::train {

struct FinetuneConfig {
  std::string mode = "default";  // "default": distance to rank one, blurred chroma; "paper": the second singular value
  std::int64_t steps = 400;
  int photos = 4;               // of one person in a step (paper: 4)
  int synthetic_batch = 8;      // synthetic faces in a step; 0 = none
  double learning_rate = 1e-4;  // at the start; a half cosine down to a hundredth of it
  double weight = 3.0;          // of the loss on people against that on synthetic faces
  // Within the loss on people, of the hold on each photo's mean highlight; see PersonLossOptions. None in paper mode.
  double energy_weight = 0.5;
  double largest_gradient = 1.0;  // norm over all weights
  double ema =
      0.98;  // decay of the running mean of the weights, which is what is scored and kept; 0 = the weights themselves
  double held_out_share = 0.25;       // of the people, to measure on
  std::int64_t score_every = 0;       // steps between scores; 0 = at the end alone
  int validation_samples = 128;       // synthetic faces that scores are taken on, where a run has such
  double max_validation_rise = 0.05;  // share by which the error on those may rise; see kept_score()
  std::int64_t save_every = 50;       // steps between checkpoints
  std::uint64_t seed = 1;

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// Throws Error(kUsage): not JSON, a key that does not exist (the sentence names it and those that do), a value of another type, a config
// that does not validate. What is not named keeps its default.
FinetuneConfig finetune_config_from_json(const std::string& text);
std::string to_json(const FinetuneConfig& config);

struct FinetuneRun {
  FinetuneConfig config;
  std::vector<PersonSet> people;
  std::filesystem::path start;
  std::filesystem::path synthetic;   // read where the config's synthetic_batch is not 0
  std::filesystem::path validation;  // synthetic faces of other people, to measure on; empty: no such error is known
  std::filesystem::path folder;  // made; a run that is there goes on if its config, people, data and start are the same
  int threads = 0;
};

// Of the averaged weights at some step. The first three are means over people that were held out.
struct FinetuneScore {
  std::int64_t step = 0;
  int people = 0;
  double residual = 0;   // beyond rank one, of the diffuse chromaticity, root mean square per pixel
  double untouched = 0;  // the same with no highlights taken off
  double energy = 0;     // mean highlight, 0 .. 1, linear
  // Of the highlight on the skin of validation faces, mean of the root mean square, on the 0-255 scale; 0 without such faces.
  double synthetic_rmse = 0;
};

struct FinetuneRow {
  std::int64_t step = 0;
  double residual = 0;        // means since the last row, of what was trained on; as FinetuneScore's
  double energy = 0;          // mean highlight, 0 .. 1, linear
  double guards = 0;          // loss of the guards against layers that no skin has, weighted
  double synthetic_loss = 0;  // of the synthetic faces, without unit
};

struct FinetuneReport {
  std::vector<FinetuneScore> scores;  // in the order of their steps; the first is of the start, step 0
  std::vector<FinetuneRow> rows;      // of the whole run, resumed parts included
  FinetuneScore before, after;        // of the start, and of the weights that are kept
  std::filesystem::path weights;      // those that are kept
  std::int64_t steps = 0;             // of the config
  double max_validation_rise = 0;     // likewise
  bool validated = false;             // on synthetic faces too
  bool finished = false;              // to the last step; false: it was stopped before
};

struct FinetuneHooks {
  std::function<void(const FinetuneRow&, std::int64_t steps)> progress;  // at each row; of how many steps
  std::function<void(const FinetuneScore&)> scored;                      // at each score
  std::function<bool()> stop;  // asked at each step; true ends the run, which goes on from there when it is given again
  // Writes a picture into the run's folder; without it none are made.
  std::function<void(const std::filesystem::path&, const ByteImage&)> write_picture;
};

// Throws Error: kInput (weights of another architecture than those, too few people, data that cannot be read), kUsage, kOutput (a folder of
// another run, or that cannot be written), kUnexpected (the loss is no number; the checkpoint before it is kept).
FinetuneReport finetune_highlight(const FinetuneRun& run, const FinetuneHooks& hooks);

// Which of the scores' weights are kept: the number of the last one whose error on the validation faces is at most 1 + max_rise times that of
// the first, which is the start's. So the start is what is left where all training harmed too much, and the last is where nothing was
// validated. `scores`: not empty.
std::size_t kept_score(const std::vector<FinetuneScore>& scores, double max_rise);

// What became of the people who were held out and of the error on synthetic faces, before, after, and as a change in percent: a sentence that
// says which step is kept and why, and a Markdown table.
std::string finetune_table(const FinetuneReport& report);

}  // namespace faceprobe::train

#pragma once
// Finetunes the highlights of a network ("unet", "face", or the paper's "mscr") on photos of people, without labels: paper Section 3.2. One person's skin has
// the same chromaticity in every photo, so what the diffuse layers of several photos do not share is highlight that was missed, or skin
// that was taken. Every step also trains on synthetic faces, so that the network keeps what it knows.
//
//   train::FinetuneRun run;
//   run.people = train::load_people("real/finetune", {});       // one folder a person
//   run.start = "models/face.safetensors";  run.synthetic = "faces/train";  run.folder = "runs/finetuned";
//   const train::FinetuneReport report = train::finetune_highlight(run, {});
//
// Weights inherit the terms of the photos they have seen.

#include "faceprobe/net/device.h"
#include "faceprobe/train/people.h"
#include "faceprobe/train/train.h"

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
  double held_out_share = 0.25;   // of the people, to measure on
  std::uint64_t seed = 1;

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

struct FinetuneRun {
  FinetuneConfig config;
  std::vector<PersonSet> people;
  std::filesystem::path start;
  std::filesystem::path synthetic;
  std::filesystem::path folder;  // gets weights.safetensors and log.csv
  int threads = 0;
};

// Means over people.
struct PeopleScore {
  int people = 0;
  double residual = 0;   // beyond rank one, of the diffuse chromaticity, root mean square per pixel
  double untouched = 0;  // the same with no highlights taken off
  double energy = 0;     // mean highlight, 0 .. 1, linear
};

struct FinetuneRow {
  std::int64_t step = 0;
  double residual = 0;        // means since the last row, of what was trained on; as PeopleScore's
  double energy = 0;          // mean highlight, 0 .. 1, linear
  double guards = 0;          // loss of the guards against layers that no skin has, weighted
  double synthetic_loss = 0;  // of the synthetic faces, without unit
};

struct FinetuneReport {
  PeopleScore before, after;  // on people that were held out
  std::vector<FinetuneRow> rows;
  std::filesystem::path weights;
  bool finished = false;
};

struct FinetuneHooks {
  std::function<void(const FinetuneRow&, std::int64_t steps)> progress;  // at each row; of how many steps
  std::function<bool()> stop;                                            // asked at each step; true ends the run
};

// Throws Error: kInput (weights of another architecture than those, too few people), kUsage, kOutput, kUnexpected (the loss is
// no number).
FinetuneReport finetune_highlight(const FinetuneRun& run, const FinetuneHooks& hooks);

}  // namespace faceprobe::train

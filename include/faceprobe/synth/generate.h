#pragma once
// Makes data sets of synthetic faces: draws people, lights them by hundreds of maps through one matrix product per view, takes their
// pictures, writes shards. The same recipe and assets give the same bytes for any number of threads, and a run that was cut off goes on
// where it stopped.
//
//   const Assets assets = ...;                       // of assets/heads.h, assets/skins.h, assets/maps.h
//   const auto progress = [](const RunState& s) { ... };
//   const DatasetReport report = generate_dataset(assets, recipe, "faces", {.threads = 0}, progress);
//
// For training without a disk in between: generate_person() gives the samples themselves.

#include "faceprobe/synth/assets.h"
#include "faceprobe/synth/recipe.h"
#include "faceprobe/synth/shard.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace faceprobe::synth {

// Seconds spent in the parts of the work, summed over threads.
struct GenerateTimes {
  double scene = 0;      // head, clothes, ray-tracing structure
  double transport = 0;  // matrices
  double shade = 0;      // matrix products and shadow rays
  double compose = 0;    // layers, camera
  double write = 0;      // shards

  GenerateTimes& operator+=(const GenerateTimes& other);
};

// All views of one person, or of group number `person` for Recipe::multi_face. `threads` as in core/parallel.h.
std::vector<ViewSamples> generate_person(const Assets& assets, const Recipe& recipe, int person, int threads = 1,
                                         GenerateTimes* times = nullptr);

struct RunOptions {
  int threads = 0;  // people worked on at the same time; 0 = all processors
};

struct RunState {
  int samples_done = 0;   // those found on disk included
  int samples_found = 0;  // on disk at the start
  int samples_total = 0;
  double seconds = 0;  // since the start
};

struct DatasetReport {
  RunState state;
  GenerateTimes times;
};

// Throws Error: recipe not usable, no head or no map (kUsage), a head model that does not validate (kInput), folder not writable, full, or of
// another recipe (kOutput). `progress` is called by one thread at a time.
DatasetReport generate_dataset(const Assets& assets, const Recipe& recipe, const std::filesystem::path& folder,
                               const RunOptions& options = {},
                               const std::function<void(const RunState&)>& progress = {});

// Everything a data set depends on, as one JSON object: the recipe and the names of the assets.
std::string recipe_of(const Assets& assets, const Recipe& recipe);

// What the data card says; Markdown.
std::string data_card(const Assets& assets, const Recipe& recipe);

}  // namespace faceprobe::synth

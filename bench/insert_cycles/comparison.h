#pragma once
// The same scene by both renderers: once with many samples, and with few for the time.

#include "insert_cycles/figures.h"
#include "insert_cycles/sheet.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct InsertOptions {
  std::filesystem::path object;  // empty = a pot
  std::filesystem::path maps;    // folder; empty = the map made in code alone
  int map_count = 2;
  std::filesystem::path folder = "out/insert_cycles";
  std::string blender = "blender";
  int size_px = 256;
  int cycles_samples = 2048;  // of the converged pictures
  int our_samples = 4096;
  std::vector<int> timed_samples = {16, 64, 256};
  int threads = 2;
};

// One renderer's figures; errors against its own converged picture.
struct Record {
  double noise = 0;               // of the converged picture, from its two halves, which have seeds of their own
  std::vector<TimedError> timed;  // as InsertOptions::timed_samples
  std::vector<TimedError> by_cpu;  // the same in CPU seconds of all threads, which other work on the machine hardly changes
};

struct Case {
  std::string material{}, map{};
  Pair pair{};
  double error = 0;  // ours against Cycles, converged
  double beyond_noise = 0;
  Record ours{}, cycles{};
};

// All maps in one material, Cycles first, ours right after it so that both meet the same machine.
std::vector<Case> compare_material(std::size_t material, const InsertOptions& options);

}  // namespace faceprobe::bench

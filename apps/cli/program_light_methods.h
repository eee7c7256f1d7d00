#pragma once
// Rows of `faceprobe eval paper` by other people's programs, which know case folders alone (docs/cases.md).

#include "faceprobe/eval/relight_benchmark.h"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct ProgramRows {
  std::vector<std::string> methods;  // NAME=COMMAND
  int seconds = 120;                 // for a program and photo
  int samples = 100;                 // photos, as the benchmark takes them
  std::set<std::string> taken{};     // names that are rows already
  std::filesystem::path folder;  // gets cases/, made anew each time, and programs/ with what was written, which is not run again
  std::function<void(int done, int total)> progress = {};
};

struct ProgramMethods {
  std::vector<eval::LightMethod> methods;  // one a program
  std::string missing;                     // what there is no result of, and why; empty: nothing
};
// All that results hang on beside the photos; empty without programs. Throws Error(kUsage) where one is not NAME=COMMAND, or two have one name.
std::string identity_of_programs(const std::vector<std::string>& methods, int seconds);
// Runs every program on every photo, so it takes its time. Without programs it does nothing. Throws Error(kUsage) for a name that is taken and a
// program that cannot be started, Error(kInput), Error(kOutput).
ProgramMethods program_light_methods(const synth::ShardReader& faces, const ProgramRows& rows);

}  // namespace faceprobe::cli

#pragma once
// Whether an installation works: are the models there and whole, does a known light come back, does the renderer keep energy.
//
//   for (const pipeline::Check& check : pipeline::self_test()) std::cout << check.name << ": " << check.detail << '\n';
//
// Seconds, and no photo. Not a benchmark.

#include "faceprobe/core/error.h"

#include <string>
#include <vector>

namespace faceprobe::pipeline {

struct Check {
  std::string name;
  bool ok = false;
  std::string detail;             // what was found; of a failure also what to do
  ExitCode code = ExitCode::kOk;  // what a command should end with
};

// In an order in which the first failure is mostly the cause of the others. Never throws but for lack of memory.
std::vector<Check> self_test();

}  // namespace faceprobe::pipeline

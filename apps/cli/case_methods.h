#pragma once
// The rows of `faceprobe eval cases`: programs by anybody, and our own estimate.

#include "faceprobe/eval/case_benchmark.h"

#include <filesystem>
#include <string>

namespace faceprobe::cli {

// This build of the program.
std::string program_identity();
// A file's path and hash; empty for what is no file, or too large to be read each time (256 MiB).
std::string identity_of_file(const std::filesystem::path& file);

// NAME=COMMAND: the command's words, split at spaces, with the paths for {case} and {out} in them. Files that it names count with their contents, so
// that a changed script is run again. Throws Error(kUsage) where a part is missing.
eval::CaseMethod program_method(const std::string& named, int limit_s);

struct OwnMethod {
  std::string name = "faceprobe";
  std::filesystem::path weights{};  // of the network; empty = those that come with the program
  std::filesystem::path prior{};    // of the light prior; the same
  int threads = 0;
};
// The map and the highlight layer that an estimate of photo.png alone makes. Throws Error(kModel) at its first case when a model is missing.
eval::CaseMethod own_method(const OwnMethod& own);

}  // namespace faceprobe::cli

#pragma once
// The rows of `faceprobe eval relight`: whole estimates from the photo, and what stands beside them.

#include "faceprobe/eval/relight_benchmark.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct RelightRows {
  std::filesystem::path weights{};  // of the network; empty = those that come with the program
  std::filesystem::path prior{};    // of the light prior; the same
  // Data whose mean light is a row, and which Knorr & Kurz learn from where it is traced; empty = no such rows.
  std::filesystem::path training{};
  bool ablation = false;  // rows with a part of the estimate replaced by the truth
  int nside = 16;
  int threads = 0;
};
// What the rows of the mean light are called, and that light: of a thousand of the training data's photos, each as bright. Cells x 3.
inline constexpr const char* kMeanLight = "mean light of the training data";
Eigen::MatrixX3f mean_training_light(const std::filesystem::path& training, int nside);
std::vector<eval::LightMethod> relight_methods(const RelightRows& rows);
// Those of `faceprobe eval insert`, whose lights are in the photo's unit.
std::vector<eval::LightMethod> insert_methods(const RelightRows& rows);

}  // namespace faceprobe::cli

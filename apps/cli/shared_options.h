#pragma once
// Options that several verbs take, and how they become library options.

#include "faceprobe/io/limits.h"
#include "faceprobe/pipeline/estimate.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct SharedOptions {
  std::vector<std::string> inputs;
  std::string separator = pipeline::EstimateOptions{}.separator_name();
  std::string weights;
  std::string solver{lighting::solver_name(pipeline::EstimateOptions{}.solve.solver)};
  std::string landmarks;
  std::string geometry = "net";
  std::string head;  // of geometry "3dmm"
  std::string shading = "net";
  std::string shading_weights;  // of a network in the place of `shading`; empty = none
  std::string prior = "net";
  std::string compact_light = pipeline::EstimateOptions{}.solve.compact_light ? "on" : "off";
  std::optional<double> focal_px;
  std::optional<int> iterations;  // none = the defaults, with and without a light that is expected
  std::string size = "256";
  int layer_px = pipeline::EstimateOptions{}.layer_px;
  int threads = 0;
  bool deterministic = false;
  std::string device = "auto";
  io::Limits limits;
};

void add_inputs(CLI::App& command, SharedOptions& options);
void add_face_options(CLI::App& command, SharedOptions& options);
void add_solver_options(CLI::App& command, SharedOptions& options);

// Throws Error(kUsage), or Error(kDevice) for a device that is not there.
pipeline::EstimateOptions estimate_options(const SharedOptions& options);

// "x1,y1,x2,y2,..." to #points x 2. Throws Error(kUsage).
Eigen::MatrixX2f parse_landmarks(const std::string& text);
// "256" or "256x128" to the width. Throws Error(kUsage).
int parse_map_width(const std::string& text);

// Whether an output is one picture, .png, .exr or .hdr, and not a folder. Throws Error(kUsage) for a picture that is not written.
bool is_picture_output(const std::string& output);

// Folder for one of several inputs: the output folder itself for one, else a folder in it named after the photo.
std::string folder_for(const std::string& output, const SharedOptions& options, std::size_t input);

}  // namespace faceprobe::cli

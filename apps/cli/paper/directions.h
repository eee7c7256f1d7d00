#pragma once
// Lights on real faces whose directions are known: what `faceprobe eval paper` has of them, and `faceprobe eval direction` alone.
//
//   const Sections sections = measure_directions({.data = "data", .every = 12});
//   std::cout << eval::report_markdown({.title = "", .sections = sections});

#include "face_light_methods.h"
#include "paper/plan.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace faceprobe::cli {

struct DirectionRows {
  std::filesystem::path data;  // the folder that docs/data.md lays out
  int every = 1;               // every n-th photo and person
  bool yale = true, london = true;
  pipeline::EstimateOptions base = {};  // what the estimates share: weights, a head model's surface
  // Our estimate with the normals of each in the place of the usual rows; empty = the usual rows.
  std::vector<pipeline::NormalSource> normals = {};
  // Rows more of the usual kind, with one thing of our estimate changed: without the prior, code values taken for sRGB.
  bool changed = false;
  FaceRivals rivals = {};  // beside the usual rows
  std::function<void(int done, int total)> progress = {};
};
// A section a set; one whose data are not there says so. Throws Error(kModel), and Error(kInput) for tables that cannot be read.
Sections measure_directions(const DirectionRows& rows);

// Those that have an answer to a face alone. `training`: traced training faces; `weights`: folder of networks; each empty = no such rows, told in
// FaceRivals::missing. Throws Error(kInput), Error(kModel).
struct RivalSources {
  std::filesystem::path training = {}, weights = {};
  int threads = 0;
};
FaceRivals direction_rivals(const RivalSources& sources);

// Whether the data folder has one of the sets.
bool has_directions(const std::filesystem::path& data);

}  // namespace faceprobe::cli

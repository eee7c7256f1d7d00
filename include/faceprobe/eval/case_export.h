#pragma once
// Synthetic photos as cases of the open benchmark, with every truth that the format has room for.
//
//   const synth::ShardReader faces("faces/dev");
//   const int written = eval::export_cases(faces, "cases", {.samples = 20});

#include "faceprobe/synth/shard.h"

#include <filesystem>
#include <functional>
#include <string>

namespace faceprobe::eval {

struct CaseExport {
  int samples =
      100;  // photos, of as many people as possible; groups in rooms and those that show less than 5 % skin are left out
  // The kind of scene that a map is of, by its number in the data, for group "scene"; empty = not known.
  std::function<std::string(int map)> scene = {};
  std::string licence = {};  // of every case
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

// One folder a photo, named by its number in the data; returns how many. The mask is the face's own skin inside the face that an estimate would
// find, normals are those of skin, eyes and mouth. Groups: tone, and person. Throws Error(kUsage) for options that do not validate, Error(kInput), Error(kOutput).
int export_cases(const synth::ShardReader& faces, const std::filesystem::path& folder, const CaseExport& options);

}  // namespace faceprobe::eval

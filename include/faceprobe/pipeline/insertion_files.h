#pragma once
// The folder that `faceprobe insert` leaves:
//
//   composite.png   the photo with the thing in it;  composite.exr: linear, nothing clipped
//   object.png      the thing alone, straight alpha;  object.exr: linear, premultiplied
//   shadow.exr      factor on the photo;  depth.exr (metres), normal.exr (camera frame)
//   insert.json     what stands where, in which light
//
// Layers have the photo's size.

#include "faceprobe/pipeline/insertion.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::pipeline {

// Writes everything and returns the files, in order. Throws Error(kOutput). `photo`, `object`: what the user called them.
std::vector<std::filesystem::path> write_insertion(const std::filesystem::path& folder, const insert::Insertion& done,
                                                   const insert::Scene& scene, const std::string& photo,
                                                   const std::string& object);

// What insert.json says: one object, UTF-8, indented, schema "faceprobe-insert/1"; metres and pixels as its names end.
std::string insertion_json(const insert::Insertion& done, const insert::Scene& scene, const std::string& photo,
                           const std::string& object);

}  // namespace faceprobe::pipeline

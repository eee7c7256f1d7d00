#pragma once
// The folder that `faceprobe estimate` leaves. One face: all files in the folder itself. Several: face_1 .. face_N from left to right
// with the same files, and joint/ with the maps of all of them; the largest face's maps and overview are also at the top.
//
//   environment.exr .hdr .png   confidence.exr   environment_rest.exr light.usda light.gltf blender.py (scene_files.h)
//   highlight|diffuse|albedo|shading|normals .exr .png   regions.png
//   overview.png   report.json (top folder only)
//
// joint/ of several photos (write_joint) has a report.json as well.

#include "faceprobe/pipeline/estimate.h"
#include "faceprobe/pipeline/report.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::pipeline {

struct OutputOptions {
  Orientation orientation = Orientation::kOpenExr;  // of the environment maps
  bool layers = true;
  bool overview = true;
};

// The folder of face `index`, from 0, where there are several: "face_1".
inline std::string face_folder(std::size_t index) { return "face_" + std::to_string(index + 1); }

// Attributes for files that can carry them (EXR, PNG): version, frame, solver, separator, hash of the photo.
std::map<std::string, std::string> provenance(const io::Photo& photo, const EstimateOptions& options);
// The same of a light that is of no one photo.
std::map<std::string, std::string> provenance(const EstimateOptions& options);

// How the columns of a map are laid out, for people and attributes.
std::string orientation_name(Orientation orientation);
// Of what users call it: "openexr", "three" or "blender", "debevec". Throws Error(kUsage), which calls the value `what`.
Orientation orientation_from_name(const std::string& name, const std::string& what = "--orient");

// Writes everything and returns the files, in order. Throws Error(kOutput). `source` is what the user called the photo.
std::vector<std::filesystem::path> write_outputs(const std::filesystem::path& folder, const Estimate& estimate,
                                                 const io::Photo& photo, const EstimateOptions& options,
                                                 const std::string& source, const OutputOptions& output = {});

// The maps and scenes of one light alone. Returns and throws as write_outputs().
std::vector<std::filesystem::path> write_light(const std::filesystem::path& folder, const LightResult& light,
                                               const EstimateOptions& options, const OutputOptions& output = {});

// The same of the joint light of several photos, with a report.json of its own (joint_report_json). Returns and throws as write_outputs().
std::vector<std::filesystem::path> write_joint(const std::filesystem::path& folder, const LightResult& light,
                                               const std::vector<JointPhoto>& photos, const EstimateOptions& options,
                                               const OutputOptions& output = {});

}  // namespace faceprobe::pipeline

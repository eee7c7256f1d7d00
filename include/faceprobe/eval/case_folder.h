#pragma once
// One case of the open benchmark: a folder with a photo and what is known of it, which anybody can make. docs/cases.md has the format.
//
//   for (const std::filesystem::path& folder : eval::case_folders("cases")) {
//     const eval::Case one = eval::read_case(folder);
//     if (one.light) std::cout << one.name << ": " << one.light->integral().transpose() << '\n';
//   }
//
// Not for training data, of which there is too much for a folder each: synth/shard.h.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/face/face.h"
#include "faceprobe/io/limits.h"

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::eval {

struct CasePose {
  face::Camera camera;
  // Metres. The head: +x the subject's left (right in a frontal photo), +y up, +z out of the face, origin between the eyes.
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
};

// Photo and one truth, highlight or light, are always there; what else is empty is not known. Pictures are of one size.
struct Case {
  std::string name;                           // of the folder
  ByteImage photo;                            // H x W x 3, sRGB
  Image highlight;                            // H x W x 3, linear, 1 = the photo's white
  Image diffuse;                              // the same
  Image normal_cam;                           // H x W x 3, unit length, 0 off the face
  ByteImage mask;                             // H x W x 1: 255 where highlights are judged, else 0; empty = everywhere
  std::optional<EnvMap> light;                // true light, camera frame, any scale
  std::optional<CasePose> pose;               // of the camera and the head
  std::map<std::string, std::string> groups;  // kind of group -> label: {"scene", "indoor"}
  std::string licence;                        // for people

  // Empty when all that is there fits together, else a sentence that begins with the name of the file that does not.
  std::string validate() const;
};

// Throws Error(kInput) naming the file: missing, unreadable, over a limit, or not what the format says. Files that it does not know are not read.
Case read_case(const std::filesystem::path& folder, const io::Limits& limits = {});

// Makes the folder; the light becomes gt.hdr. `name` is not written. Throws Error(kOutput), std::invalid_argument for a case that does not validate.
void write_case(const std::filesystem::path& folder, const Case& one);

// The folders in `data`, by name; hidden ones are left out. Throws Error(kInput) when there is none.
std::vector<std::filesystem::path> case_folders(const std::filesystem::path& data);

// Hexadecimal SHA-256 of the files that the format names; where the folder lies and how it is called do not matter. Throws Error(kInput).
std::string case_hash(const std::filesystem::path& folder, const io::Limits& limits = {});

// What a method wrote for a case. Empty: it has nothing to say of that.
struct CaseResult {
  std::optional<EnvMap> light;  // of map.hdr or map.exr, camera frame, any scale; not black
  Image highlight;              // of highlight.exr, H x W x 3, linear, 1 = the photo's white
};
// Values below 0 become 0. Throws Error(kInput), whose sentence names the file alone: neither is there, or one is unreadable, of another size
// than the photo, not finite, black.
CaseResult read_case_result(const std::filesystem::path& folder, int photo_width, int photo_height,
                            const io::Limits& limits = {});

}  // namespace faceprobe::eval

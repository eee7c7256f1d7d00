#pragma once
// Finds the dense face mesh in the photos of a synthetic data set, as it is found in anybody's photo, and leaves it beside the shards: the
// face network is given that mesh, with the errors it has (synth/shard.h, FoundMesh).
//
//   const pipeline::MeshCount count = pipeline::find_meshes("faces/train", finder);
//
// One mesh a view: all lights on it show the same surface. The first photo of a view in which a face is seen says what it is.

#include "faceprobe/face/face.h"

#include <filesystem>
#include <functional>

namespace faceprobe::pipeline {

struct MeshCount {
  int views = 0;
  int found = 0;
};

// The finder should look for faces down to face::kSmallFacePx. Shards that have their meshes are left as they are. `progress`: shards done,
// of how many. Throws Error(kInput) for no data set, Error(kOutput) when it cannot be written to.
MeshCount find_meshes(const std::filesystem::path& folder, const face::FaceFinder& finder,
                      const std::function<void(int, int)>& progress = {});

}  // namespace faceprobe::pipeline

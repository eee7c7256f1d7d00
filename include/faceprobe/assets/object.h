#pragma once
// A thing to be lit, from a file.
//
//   const synth::SurfaceMesh bunny = assets::load_object("stanford-bunny.obj");

#include "faceprobe/synth/mesh.h"

#include <filesystem>

namespace faceprobe::assets {

// Wavefront OBJ, one mesh of Material::kObject as it lies in the file; smooth normals are made from the triangles. Throws Error(kInput):
// unreadable, a number that is none, not finite, an index out of range, no triangles.
synth::SurfaceMesh load_object(const std::filesystem::path& path);

}  // namespace faceprobe::assets

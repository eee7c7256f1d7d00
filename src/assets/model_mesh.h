#pragma once
// Internal: assimp's meshes as ours.

#include "assets/model_checks.h"

#include <assimp/scene.h>

namespace faceprobe::assets {

// Before assimp's steps, which believe all of this: indices in range, finite vertices, and not too many triangles once every
// node has its copy. Throws Error(kInput).
void check_scene(const ModelFile& file, const aiScene& scene);

// After the steps: one for each mesh of each node, where the node puts it. Normals that are none are made anew.
std::vector<render::TriangleMesh> read_meshes(const ModelFile& file, const aiScene& scene,
                                              std::vector<std::string>& warnings);

// Where there is no texture at all: the mean colour of a material's vertices becomes its colour, times what it was for glTF.
// `encoded` colours are sRGB, as scanners write them.
void take_vertex_colours(const ModelFile& file, const aiScene& scene, bool encoded, LoadedModel& loaded);

}  // namespace faceprobe::assets

#pragma once
// The faces of a photo as meshes in a glTF scene, so that its readers show where somebody stands.

#include "faceprobe/pipeline/estimate.h"

#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {

// Gives the nodes "Face 1", "Face 2", ... of room_gltf() the meshes of the estimate's faces (468 vertices, metres, from the node's place on),
// grey, in one buffer within the text. Nodes of faces without a mesh stay as they are. Throws Error(kModel) without the mesh's file.
void add_face_meshes(nlohmann::ordered_json& gltf, const Estimate& estimate);

}  // namespace faceprobe::pipeline

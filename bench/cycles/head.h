#pragma once
// The head and the camera of the comparison with Cycles: ICT FaceKit's neutral head, three-quarter view, every part that casts shadows.

#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/mesh.h"

#include <filesystem>

namespace faceprobe::bench {

// The model's vertices are ordered by region; region 0 (face, ears, front of the scalp and neck) comes first.
inline constexpr int kFaceVertices = 9409;

// Skin, mouth, teeth and eyeballs as one surface with the model's vertex numbers; metres, origin midway between the eyes.
// The helper shells over the eyes and the lashes are left out. Throws Error(kInput) when the file is not there or not that model.
synth::SurfaceMesh load_head(const std::filesystem::path& data);

// From 0.8 m, the head turned to the right of the picture and a little down, filling the picture.
synth::PinholeCamera head_camera(int size_px);

// The mesh as the camera has it.
synth::SurfaceMesh in_camera_frame(synth::SurfaceMesh mesh, const synth::PinholeCamera& camera);

}  // namespace faceprobe::bench

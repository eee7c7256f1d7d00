#pragma once
// What several loaders do alike.

#include "faceprobe/synth/head_model.h"

#include <filesystem>
#include <string>

namespace faceprobe::assets {

// Colour models are linear in sRGB-encoded values, ours in light. set: mean and modes still encoded, 0 .. 1; finish: mean decoded,
// modes multiplied by the curve's slope there, which is exact for small modes.
void set_encoded_albedo(synth::HeadModel& model, Eigen::MatrixX3f mean);
void add_encoded_albedo_mode(synth::HeadModel& model, Eigen::MatrixX3f mode);
void finish_albedo(synth::HeadModel& model);

// All triangles are turned over if the surface, seen as a whole, faces inwards.
void turn_outwards(synth::HeadModel& model);
// All triangles become skin.
void make_all_skin(synth::HeadModel& model);
// 68 numbers of vertices, from 0, out of FILE_WITHOUT_EXTENSION.landmarks.txt; nothing when there is no such file. Throws
// Error(kInput) when it holds anything else.
void read_landmarks_beside(const std::filesystem::path& path, synth::HeadModel& model);

// By the landmarks. Without them the farthest vertex along +z is taken for the tip of the nose, from which the eyes' middle lies
// 43 mm up and 35 mm back in an average face.
void move_origin_between_eyes(synth::HeadModel& model);
// Throws Error(kInput) with validate()'s sentence.
void require_valid(const synth::HeadModel& model, const std::string& file);

}  // namespace faceprobe::assets

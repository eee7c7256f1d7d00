#pragma once
// Head models that other people made, as synth::HeadModel: metres, the origin midway between the eyes, +z out of the face. Each is
// checked to the last number (HeadModel::validate); a file that is not what it should be is an Error(kInput) that says what was found.
//
//   const std::vector<synth::HeadModel> heads = assets::load_heads("models/");

#include "faceprobe/synth/head_model.h"

#include <filesystem>
#include <vector>

namespace faceprobe::assets {

// USC's ICT-FaceKit (Light): the folder of its OBJ files (generic_neutral_mesh.obj, identityNNN.obj, one OBJ for each expression), or
// the same as arrays (ict_topology.npz with morphs_full_f16.npz, or with {identity,expression}_head_f16.npy for the skin alone; then
// eyes and mouth follow identity, not expression). Skin, eyeballs, inside of the mouth, teeth; the transparent shells over the eyes
// and the lashes are left out.
synth::HeadModel load_ict_head(const std::filesystem::path& folder);

// Basel Face Model: 2009 as MATLAB file (01_MorphableModel.mat), 2017 and 2019 as HDF5 (.h5, statismo's layout). All skin; albedo comes
// from the colour model, decoded to linear; expressions are statistics without names. Landmarks: the file's own when they are named
// "0" to "67", else NAME.landmarks.txt as for an OBJ, else none.
synth::HeadModel load_basel_head(const std::filesystem::path& path);

struct ObjHeadOptions {
  // Metres per unit of the file. 0: guessed from the height of its box: over 100 units are millimetres, over 5 centimetres, else metres.
  float units_m = 0;
};
// Any OBJ as one head of skin without modes. Taken to be a head from the neck up, upright (+y) and looking along +z; the origin goes
// midway between the eyes if landmarks are there, else to where the eyes are in an average face with that tip of the nose (the farthest
// vertex along +z). Beside NAME.obj may lie NAME.landmarks.txt (68 vertex numbers, from 0, in Multi-PIE order) and a texture: map_Kd of
// its material, or NAME.png or NAME.jpg. Without landmarks all skin is of Region::kOther.
synth::HeadModel load_obj_head(const std::filesystem::path& path, const ObjHeadOptions& options = {});

// What is there, by name: a file of the above, an ICT-FaceKit folder, a folder of files, or else the folders directly in it. Error(kInput)
// when nothing is found.
std::vector<synth::HeadModel> load_heads(const std::filesystem::path& path);

}  // namespace faceprobe::assets

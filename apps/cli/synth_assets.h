#pragma once
// What synthetic faces are made of, from the files that a command names.

#include "faceprobe/synth/assets.h"
#include "faceprobe/synth/mixed_maps.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

struct SynthSources {
  std::vector<std::string> packed;    // files of `faceprobe synth pack`
  std::vector<std::string> heads;     // ICT-FaceKit folder, Basel .mat or .h5, .obj; none = the built-in head
  std::string skins;                  // folder of textures; empty = skin made without a picture
  std::string maps;                   // folder of HDR maps; empty = the built-in ones
  std::string reflectance;            // measured skin reflectance; empty = the built-in estimate
  synth::MixOptions mixed_maps = {};  // made of the maps above, and added to them
  int threads = 0;
};
// Throws Error(kInput) for what cannot be read.
synth::Assets load_synth_assets(const SynthSources& sources);

}  // namespace faceprobe::cli

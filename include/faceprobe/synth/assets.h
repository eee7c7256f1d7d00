#pragma once
// What faces are made from: head models, skin textures, environment maps. Plain data; assets/ loads it from files.

#include "faceprobe/synth/head_model.h"
#include "faceprobe/synth/map_light.h"
#include "faceprobe/synth/skin.h"

#include <vector>

namespace faceprobe::synth {

struct Assets {
  std::vector<HeadModel> heads;    // at least one
  std::vector<SkinTexture> skins;  // may be empty: plain skin then
  std::vector<MapLight> maps;      // at least one
};

}  // namespace faceprobe::synth

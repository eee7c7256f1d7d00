#pragma once
// What faces are made from: head models, skin textures, environment maps. Plain data; assets/ loads it from files.
//
//   const Assets own{.heads = {procedural_head()}, .maps = {prepare_map("studio", map, {})}};

#include "faceprobe/synth/head_model.h"
#include "faceprobe/synth/map_light.h"
#include "faceprobe/synth/skin.h"

#include <optional>
#include <vector>

namespace faceprobe::synth {

struct Assets {
  std::vector<HeadModel> heads;               // at least one
  std::vector<SkinTexture> skins;             // may be empty: plain skin then
  std::vector<MapLight> maps;                 // at least one
  std::optional<SkinStatistics> reflectance;  // measured; else the estimate of core/skin_reflectance.h
};

}  // namespace faceprobe::synth

#pragma once
// A data set small enough for a test: the built-in head and maps.

#include "faceprobe/synth/generate.h"
#include "faceprobe/synth/procedural_head.h"
#include "faceprobe/synth/procedural_maps.h"

namespace faceprobe::synth {

inline Assets small_assets() {
  Assets assets;
  assets.heads.push_back(procedural_head());
  for (const auto& [name, map] : procedural_maps()) assets.maps.push_back(prepare_map(name, map, {}));
  return assets;
}

inline Recipe small_recipe() {
  Recipe recipe;
  recipe.count = 7;  // the second person is cut short
  recipe.size_px = 48;
  recipe.views_per_person = 2;
  recipe.samples_per_view = 2;
  recipe.skins_per_person = 2;
  recipe.samples_per_side = 2;
  recipe.nside = 8;
  recipe.bounce_rays = 8;
  recipe.environment_height = 16;
  return recipe;
}

}  // namespace faceprobe::synth

#include "synth_assets.h"

#include "faceprobe/assets/heads.h"
#include "faceprobe/assets/maps.h"
#include "faceprobe/assets/reflectance_statistics.h"
#include "faceprobe/assets/skins.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/generate.h"
#include "faceprobe/synth/procedural_head.h"
#include "faceprobe/synth/procedural_maps.h"

#include <utility>

namespace faceprobe::cli {

synth::Assets load_synth_assets(const SynthSources& sources) {
  synth::Assets assets;
  for (const std::string& path : sources.heads) {
    for (synth::HeadModel& model : assets::load_heads(path)) assets.heads.push_back(std::move(model));
  }
  if (assets.heads.empty()) assets.heads.push_back(synth::procedural_head());
  if (!sources.skins.empty()) {
    for (auto& [name, picture] : assets::load_skins(sources.skins)) {
      assets.skins.push_back(synth::prepare_texture(name, std::move(picture)));
    }
  }
  if (!sources.reflectance.empty())
    assets.reflectance = assets::skin_statistics(assets::load_reflectance_statistics(sources.reflectance));
  const std::vector<std::pair<std::string, EnvMap>> maps =
      sources.maps.empty() ? synth::procedural_maps() : assets::load_maps(sources.maps);
  assets.maps.resize(maps.size());
  parallel_for(static_cast<int>(maps.size()), sources.threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const auto& [name, map] = maps[static_cast<std::size_t>(i)];
      assets.maps[static_cast<std::size_t>(i)] = synth::prepare_map(name, map, {});
    }
  });
  return assets;
}

}  // namespace faceprobe::cli

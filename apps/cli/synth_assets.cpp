#include "synth_assets.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/asset_file.h"
#include "faceprobe/synth/generate.h"
#include "faceprobe/synth/procedural_head.h"
#include "faceprobe/synth/procedural_maps.h"

#ifndef FACEPROBE_LEAN
#include "faceprobe/assets/heads.h"
#include "faceprobe/assets/maps.h"
#include "faceprobe/assets/reflectance_statistics.h"
#include "faceprobe/assets/skins.h"
#endif

#include <iterator>
#include <utility>

namespace faceprobe::cli {

namespace {

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

// In the order of the options; packed files come first.
synth::AssetSources read_sources(const SynthSources& named) {
  synth::AssetSources sources;
  for (const std::string& path : named.packed) {
    synth::AssetSources file = synth::read_asset_file(path);
    append(sources.heads, std::move(file.heads));
    append(sources.skins, std::move(file.skins));
    append(sources.maps, std::move(file.maps));
    if (file.reflectance) sources.reflectance = file.reflectance;
  }
#ifndef FACEPROBE_LEAN
  for (const std::string& path : named.heads) append(sources.heads, assets::load_heads(path));
  if (!named.skins.empty()) append(sources.skins, assets::load_skins(named.skins));
  if (!named.maps.empty()) append(sources.maps, assets::load_maps(named.maps));
  if (!named.reflectance.empty())
    sources.reflectance = assets::skin_statistics(assets::load_reflectance_statistics(named.reflectance));
#else
  if (!named.heads.empty() || !named.skins.empty() || !named.maps.empty() || !named.reflectance.empty()) {
    throw Error(
        ExitCode::kUsage,
        "This build reads no files of others; pack them by the full command's `synth pack` and give the result with "
        "--assets.");
  }
#endif
  return sources;
}

}  // namespace

synth::Assets load_synth_assets(const SynthSources& named) {
  synth::AssetSources sources = read_sources(named);
  synth::Assets assets;
  assets.heads = std::move(sources.heads);
  if (assets.heads.empty()) assets.heads.push_back(synth::procedural_head());
  for (auto& [name, picture] : sources.skins) assets.skins.push_back(synth::prepare_texture(name, std::move(picture)));
  assets.reflectance = sources.reflectance;
  std::vector<synth::NamedMap> maps = sources.maps.empty() ? synth::procedural_maps() : std::move(sources.maps);
  append(maps, synth::mixed_maps(maps, named.mixed_maps));
  assets.maps.resize(maps.size());
  parallel_for(static_cast<int>(maps.size()), named.threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const auto& [name, map] = maps[static_cast<std::size_t>(i)];
      assets.maps[static_cast<std::size_t>(i)] = synth::prepare_map(name, map, {});
    }
  });
  return assets;
}

}  // namespace faceprobe::cli

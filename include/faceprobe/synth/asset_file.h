#pragma once
// What faces are made from, in .safetensors files of our own, so that a machine that has none of the libraries for other people's formats
// can make faces too: heads with their modes as float16, skins as encoded bytes, maps as float16 at the size they are given in.
//
//   write_asset_file("faces.safetensors", {.heads = heads, .skins = skins});
//   const AssetSources sources = read_asset_file("faces.safetensors");
//
// Faces made of them are not those of the originals to the last bit: rounding a mode moves a vertex by micrometres.

#include "faceprobe/core/env_map.h"
#include "faceprobe/synth/head_model.h"
#include "faceprobe/synth/skin.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::synth {

// As loaders give them, before prepare_texture() and prepare_map(); any list may be empty.
struct AssetSources {
  std::vector<HeadModel> heads = {};
  std::vector<std::pair<std::string, ByteImage>> skins = {};  // three channels
  std::vector<std::pair<std::string, EnvMap>> maps = {};      // of any size each, scene frame
  std::optional<SkinStatistics> reflectance = {};
};

// Throws Error(kInput) for a head that does not validate and for maps that hold what is not finite, Error(kOutput) when the file cannot be
// written; std::invalid_argument for skins of another number of channels.
void write_asset_file(const std::filesystem::path& path, const AssetSources& sources);
// Throws Error(kInput) for a file that is damaged, of another format, or holds a head that does not validate.
AssetSources read_asset_file(const std::filesystem::path& path);

}  // namespace faceprobe::synth

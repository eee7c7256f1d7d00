#include "commands.h"
#include "faceprobe/assets/heads.h"
#include "faceprobe/assets/maps.h"
#include "faceprobe/assets/reflectance_statistics.h"
#include "faceprobe/assets/skins.h"
#include "faceprobe/core/error.h"
#include "faceprobe/synth/asset_file.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::vector<std::string> heads;
  std::string skins;
  std::string maps;
  std::string reflectance;
  std::string output;
  int map_height = 128;
};

int run(const Options& options) {
  synth::AssetSources sources;
  for (const std::string& path : options.heads) {
    for (synth::HeadModel& model : assets::load_heads(path)) sources.heads.push_back(std::move(model));
  }
  if (!options.skins.empty()) sources.skins = assets::load_skins(options.skins);
  if (!options.reflectance.empty())
    sources.reflectance = assets::skin_statistics(assets::load_reflectance_statistics(options.reflectance));
  if (!options.maps.empty()) sources.maps = assets::load_maps(options.maps);
  for (auto& [name, map] : sources.maps) {
    if (map.height() > options.map_height) map = resize(map, 2 * options.map_height, options.map_height);
  }
  if (sources.heads.empty() && sources.skins.empty() && sources.maps.empty() && !sources.reflectance)
    throw Error(ExitCode::kUsage, "There is nothing to pack; give --heads, --skins, --maps or --reflectance.");
  synth::write_asset_file(options.output, sources);
  spdlog::info("{} heads, {} skins and {} maps in {}, {:.1f} MB", sources.heads.size(), sources.skins.size(),
               sources.maps.size(), options.output,
               static_cast<double>(std::filesystem::file_size(options.output)) / 1e6);
  return 0;
}

}  // namespace

CLI::App* add_pack(CLI::App& synth, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = synth.add_subcommand("pack", "heads, skins and maps in one small file, for `synth --assets`");
  command->fallthrough(false);
  command->add_option("--heads", options->heads, "head models, as of `synth`; default: none")->type_name("PATH");
  command->add_option("--skins", options->skins, "folder of skin textures; default: none")->type_name("DIR");
  command->add_option("--maps", options->maps, "folder of HDR environment maps; default: none")->type_name("DIR");
  command->add_option("--reflectance", options->reflectance, "measured skin reflectance; default: none")
      ->type_name("FILE");
  command->add_option("--map-height", options->map_height, "maps that are higher are reduced to this, px")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "the file")->type_name("FILE")->required();
  command->footer(
      "Modes of heads and maps are kept as float16. scripts/train_gpu.sh takes such files to another "
      "machine.\n\nExample:\n"
      "  faceprobe synth pack --heads ict_facekit --skins skins -o faces.safetensors");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
  return command;
}

}  // namespace faceprobe::cli

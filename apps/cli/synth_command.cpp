#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/synth/contact_sheet.h"
#include "faceprobe/synth/generate.h"
#include "json_line.h"
#include "progress.h"
#include "synth_assets.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <system_error>
#include <vector>

namespace faceprobe::cli {

namespace {

struct Options {
  SynthSources sources;
  std::string output = "faces";
  std::string preview;
  std::string mode = "default";
  std::string split = "all";
  std::string lamp_distance;
  int preview_count = 64;
  int threads = 0;
  bool json = false;
  synth::Recipe recipe;
};

// "1,4" as those two numbers.
std::array<double, 2> two_distances(const std::string& text) {
  std::array<double, 2> distances{};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, distances[0]);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == ',') {
    const auto second = std::from_chars(first.ptr + 1, end, distances[1]);
    if (second.ec == std::errc() && second.ptr == end) return distances;
  }
  throw Error(ExitCode::kUsage, "--lamp-distance is '" + text +
                                    "'; wanted are two distances in metres with a comma between, such as 1,4.");
}

void show(const synth::RunState& state, Progress& progress) {
  const int made = state.samples_done - state.samples_found;
  if (made > 0) {
    progress.show(
        made, state.samples_total - state.samples_found,
        fmt::format("{} of {} samples, {:.1f} a second", state.samples_done, state.samples_total, made / state.seconds));
  } else if (state.samples_found > 0) {
    spdlog::info("{} of {} samples are there already", state.samples_found, state.samples_total);
  }
}

// Samples spread evenly over the data set, so that a sheet shows as many people as it can.
void write_preview(const Options& options) {
  const synth::ShardReader reader(options.output);
  const int count = std::min(options.preview_count, reader.sample_count());
  std::vector<synth::Sample> samples;
  for (int i = 0; i < count; ++i) {
    // Within a person another light each time; a stride that met every person at the same light would show one light only.
    const int at = static_cast<int>((static_cast<long long>(i) * reader.sample_count()) / count);
    samples.push_back(reader.copy_sample(at));
  }
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
  io::write_picture(options.preview, synth::contact_sheet(samples, columns));
  spdlog::info("wrote {} samples to {}", count, options.preview);
}

int run(Options options) {
  options.recipe.mode = options.mode == "paper" ? synth::Mode::kPaper : synth::Mode::kDefault;
  options.recipe.split = options.split == "train" ? synth::Split::kTrain
                         : options.split == "dev" ? synth::Split::kDev
                                                  : synth::Split::kAll;
  if (!options.lamp_distance.empty()) options.recipe.lamp_distance_m = two_distances(options.lamp_distance);
  if (const std::string problem = options.recipe.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  options.sources.threads = options.threads;
  options.sources.mixed_maps.seed = options.recipe.seed;
  if (const std::string problem = options.sources.mixed_maps.validate(); !problem.empty())
    throw Error(ExitCode::kUsage, problem);
  const synth::Assets assets = load_synth_assets(options.sources);
  Progress progress;
  const synth::DatasetReport report =
      synth::generate_dataset(assets, options.recipe, options.output, {.threads = options.threads},
                              [&](const synth::RunState& state) { show(state, progress); });
  const int made = report.state.samples_done - report.state.samples_found;
  if (options.json) {
    print_json_line({{"samples", report.state.samples_done},
                     {"samples_made", made},
                     {"seconds", report.state.seconds},
                     {"thread_seconds",
                      {{"scene", report.times.scene},
                       {"transport", report.times.transport},
                       {"shade", report.times.shade},
                       {"compose", report.times.compose},
                       {"write", report.times.write}}}});
  }
  spdlog::info("{} samples in {}, {} of them made now in {:.1f} s, {:.1f} a second", report.state.samples_done,
               options.output, made, report.state.seconds, made / std::max(report.state.seconds, 1e-3));
  if (!options.preview.empty()) write_preview(options);
  return 0;
}

}  // namespace

void add_synth(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("synth", "synthetic faces with every layer known, for training and measuring");
  synth::Recipe& recipe = options->recipe;
  command
      ->add_option("--assets", options->sources.packed,
                   "heads, skins, maps in files of `faceprobe synth pack`; what the options below name comes on top; "
                   "default: none")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--heads", options->sources.heads,
                   "head models: an ICT-FaceKit folder, Basel .mat or .h5, .obj; default: a small built-in head")
      ->type_name("PATH");
  command
      ->add_option("--skins", options->sources.skins,
                   "folder of skin textures in the head's UVs; default: skin made without a picture")
      ->type_name("DIR");
  command
      ->add_option("--maps", options->sources.maps,
                   "folder of HDR environment maps, .hdr or .exr; default: a few built-in ones")
      ->type_name("DIR");
  command
      ->add_option("--mixed-maps", options->sources.mixed_maps.count,
                   "maps to add, each mixed of two of these at other contrasts, half of them with lamps")
      ->capture_default_str();
  command
      ->add_option("--reflectance", options->sources.reflectance,
                   "measured skin reflectance (MERL/ETH ts_data.mat); default: a built-in estimate")
      ->type_name("FILE");
  command->add_option("--count", recipe.count, "samples to make")->capture_default_str();
  command->add_option("--size", recipe.size_px, "width and height of a sample, px")->capture_default_str();
  command->add_option("--seed", recipe.seed, "the same seed gives the same bytes")->capture_default_str();
  command
      ->add_option("--mode", options->mode, "what is drawn; paper: bare heads as in the ECCV 2018 paper's Section 5.1")
      ->check(CLI::IsMember({"default", "paper"}))
      ->capture_default_str();
  command->add_option("--split", options->split, "train and dev share no identity and no skin texture")
      ->check(CLI::IsMember({"all", "train", "dev"}))
      ->capture_default_str();
  command->add_flag("--multi-face", recipe.multi_face,
                    "two to four people to a picture and lamps at known places among distant light; from 192 px");
  command->add_option("--people", recipe.people, "with --multi-face: people to a picture; default: two to four, drawn");
  command->add_option("--lamps", recipe.lamps,
                      "with --multi-face: lamps of a picture, 0 for distant light alone; default: one to three, drawn");
  command
      ->add_option("--lamp-distance", options->lamp_distance,
                   "with --multi-face: metres of every lamp from every face; default: 0.55 at least")
      ->type_name("LOW,HIGH");
  command->add_option("--views", recipe.views_per_person, "poses of each person")->capture_default_str();
  command->add_option("--lights", recipe.samples_per_view, "maps that light each pose")->capture_default_str();
  command->add_option("--skins-per-person", recipe.skins_per_person, "skins that take turns")->capture_default_str();
  command->add_option("-o,--output", options->output, "folder for the shards, index.json and CARD.md")
      ->type_name("DIR")
      ->capture_default_str();
  command
      ->add_option("--preview", options->preview,
                   "also write a contact sheet of the data set to this picture; default: none")
      ->type_name("FILE");
  command->add_option("--preview-count", options->preview_count, "samples on the sheet")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  command->add_option("--threads", options->threads, "people made at the same time; 0 = all processors")
      ->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end");
  command->footer(
      "A run that was cut off goes on where it stopped when the same command is given again.\n\nExample:\n"
      "  faceprobe synth --heads ict_facekit --skins skins --maps hdri/train --count 20000 --seed 1 --split train \\\n"
      "    -o faces --preview faces.png");
#ifndef FACEPROBE_LEAN
  const std::vector<const CLI::App*> others = {add_unwrap(*command, action), add_pack(*command, action)};
#else
  const std::vector<const CLI::App*> others;
#endif
  command->callback([options, others, &action] {
    if (std::ranges::none_of(others, [](const CLI::App* other) { return other->parsed(); }))
      action = [options] { return run(*options); };
  });
}

}  // namespace faceprobe::cli

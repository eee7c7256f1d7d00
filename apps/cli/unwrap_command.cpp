#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/unwrap.h"
#include "json_line.h"
#include "one_head.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string head;
  std::string output = "skins";
  std::string coverage;
  std::string separator{highlight::separator_name(pipeline::UnwrapOptions{}.separator)};
  bool json = false;
  pipeline::UnwrapOptions unwrap;
};

// Where one of several textures goes: OUTPUT/NAME.png, or OUTPUT itself when that is a picture's name.
std::filesystem::path texture_path(const Options& options, const std::string& input) {
  std::filesystem::path output = options.output;
  if (output.extension() == ".png") return output;
  return output / (std::filesystem::path(input).stem().string() + ".png");
}

int run(Options options) {
  options.unwrap.separator = highlight::separator_from_name(options.separator);
  if (const std::string problem = options.unwrap.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  if (options.inputs.size() > 1 && std::filesystem::path(options.output).extension() == ".png") {
    throw Error(ExitCode::kUsage, "Several photos cannot become one picture; give a folder with -o.");
  }
  const synth::HeadModel model = load_one_head(options.head);
  const face::FaceFinder finder({.threads = options.unwrap.threads});
  int failures = 0;
  int last = 0;
  for (const std::string& input : options.inputs) {
    const int code = run_guarded([&] {
      const pipeline::Unwrapped skin = pipeline::unwrap(io::load_photo(input), model, finder, options.unwrap);
      const std::filesystem::path path = texture_path(options, input);
      if (path.has_parent_path()) io::create_folder(path.parent_path());
      io::write_picture(path, skin.texture);
      if (!options.coverage.empty()) {
        io::create_folder(options.coverage);
        io::write_picture(std::filesystem::path(options.coverage) / path.filename(), skin.coverage);
      }
      const pipeline::UnwrapReport& report = skin.report;
      if (options.json) {
        print_json_line({{"photo", input},
                         {"texture", path.string()},
                         {"residual_px", report.residual_px},
                         {"face_width_px", report.face_width_px},
                         {"yaw_deg", report.yaw_deg},
                         {"pitch_deg", report.pitch_deg},
                         {"covered", report.covered},
                         {"shading_taken", report.shading_taken}});
      }
      spdlog::info("{}: wrote {}; {:.0f} % of the face read from the photo", input, path.string(), 100 * report.covered);
      return 0;
    });
    if (code == 0) continue;
    ++failures;
    last = code;
  }
  if (failures == 0) return 0;
  return options.inputs.size() > 1 ? static_cast<int>(ExitCode::kBatchFailures) : last;
}

}  // namespace

CLI::App* add_unwrap(CLI::App& synth, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = synth.add_subcommand("unwrap", "a skin texture in a head's UVs out of a frontal photo");
  command->fallthrough(false);
  command->add_option("PHOTO", options->inputs, "photos, a face each; of several the largest is taken")
      ->type_name("FILE")
      ->required();
  command->add_option("--head", options->head, "head model with UVs and landmarks, such as an ICT-FaceKit folder")
      ->type_name("PATH")
      ->required();
  command->add_option("-o,--output", options->output, "folder for NAME.png, or for one photo a .png")
      ->type_name("PATH")
      ->capture_default_str();
  command
      ->add_option("--coverage", options->coverage,
                   "folder for pictures of what was read (white) and filled (black); default: none are written")
      ->type_name("DIR");
  command->add_option("--size", options->unwrap.size_px, "width and height of the texture, px")->capture_default_str();
  command->add_option("--max-yaw", options->unwrap.max_yaw_deg, "faces turned further are refused, degrees")
      ->capture_default_str();
  command->add_option("--separator", options->separator, "what takes the highlights out")
      ->type_name("{tan,yang,shen}")
      ->capture_default_str();
  command->add_option("--threads", options->unwrap.threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object a photo on stdout");
  command->footer(
      "Hard shadows stay in the texture: take photos in soft, frontal light.\n\nExample:\n"
      "  faceprobe synth unwrap portrait.jpg --head ict_facekit -o skins");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
  return command;
}

}  // namespace faceprobe::cli

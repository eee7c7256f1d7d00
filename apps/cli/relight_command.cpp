#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/relight.h"
#include "json_line.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <memory>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "relit.png";
  std::string map;
  double turn_deg = 0;
  int dim = 0;
  double exposure = 0;
  bool json = false;
};

int run(const Options& options) {
  if (options.inputs.size() != 1)
    throw Error(ExitCode::kUsage, "One photo is relit at a time, found " + std::to_string(options.inputs.size()) + ".");
  if (!is_picture_output(options.output))
    throw Error(ExitCode::kUsage, "The relit photo is one picture; name it -o NAME.png, .exr or .hdr.");
  pipeline::LightChange change{
      .map = {}, .dim = options.dim, .turn_deg = options.turn_deg, .exposure = options.exposure};
  if (!options.map.empty()) change.map = io::read_env_map(options.map, Orientation::kOpenExr, options.limits);
  if (const std::string fault = change.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  const pipeline::Estimator estimator(estimate_options(options));
  const io::Photo photo = io::load_photo(options.inputs[0], options.limits);
  const pipeline::Estimate estimate = estimator.estimate(photo);
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}", warning);
  Image picture = photo.linear;
  for (const pipeline::FaceEstimate& face : estimate.faces)
    pipeline::relight(picture, face, pipeline::changed_light(face, change, estimator.options()),
                      {.threads = options.threads});
  io::write_picture(options.output, picture);
  if (options.json) {
    print_json_line({{"source", options.inputs[0]},
                     {"faces", estimate.faces.size()},
                     {"warnings", estimate.warnings},
                     {"picture", options.output}});
  }
  spdlog::info("{} face(s), wrote {}", estimate.faces.size(), options.output);
  return 0;
}

}  // namespace

void add_relight(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("relight", "a photo's faces in another light: a preview, of the faces alone");
  add_inputs(*command, *options);
  command->add_option("-o,--output", options->output, "the picture: NAME.png, .exr or .hdr")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--map", options->map,
                   "lat-long .exr or .hdr map that lights the faces, as strong as their own light; default: their own")
      ->type_name("FILE");
  command
      ->add_option("--dim", options->dim,
                   "put out this many of the photo's main lights, the strongest first; default: none")
      ->check(CLI::Range(1, 5));
  command
      ->add_option("--turn", options->turn_deg,
                   "turn the light about the vertical, degrees, to the right seen from above the photo")
      ->capture_default_str();
  command->add_option("--exposure", options->exposure, "stops brighter or, below 0, darker")->capture_default_str();
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->add_flag("--json", options->json, "print how many faces were relit, and the warnings, on stdout");
  command->footer(
      "Takes one photo, and one of --map, --dim, --turn and --exposure at least; --dim is of the photo's own light.\n"
      "Hair, neck, clothes and room stay as they are.\n\n"
      "Examples:\n  faceprobe relight portrait.jpg --dim 1 -o without_sun.png\n"
      "  faceprobe relight portrait.jpg --map studio.hdr --turn 40 -o studio.png");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/relight.h"
#include "json_line.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <charconv>
#include <memory>
#include <string_view>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "relit.png";
  std::string map;
  double turn_deg = 0;
  std::vector<std::string> dim;
  double exposure = 0;
  bool json = false;
};

template <class Number>
bool reads(std::string_view text, Number& number) {
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && rest == text.data() + text.size();
}

// Of "2" and "2=0.5".
pipeline::DimmedLight dimmed_from(const std::string& text) {
  pipeline::DimmedLight dimmed;
  const std::size_t equals = text.find('=');
  const bool shared = equals != std::string::npos;
  const std::string_view all = text;
  if (!reads(all.substr(0, equals), dimmed.light) || (shared && !reads(all.substr(equals + 1), dimmed.share))) {
    throw Error(ExitCode::kUsage,
                "--dim takes the number of a main light, as in 2, or that and how much of it goes, as in "
                "2=0.5; found '" +
                    text + "'.");
  }
  return dimmed;
}

int run(const Options& options) {
  if (options.inputs.size() != 1)
    throw Error(ExitCode::kUsage, "One photo is relit at a time, found " + std::to_string(options.inputs.size()) + ".");
  if (!is_picture_output(options.output))
    throw Error(ExitCode::kUsage, "The relit photo is one picture; name it -o NAME.png, .exr or .hdr.");
  pipeline::LightChange change{.map = {}, .dim = {}, .turn_deg = options.turn_deg, .exposure = options.exposure};
  for (const std::string& text : options.dim) change.dim.push_back(dimmed_from(text));
  if (!options.map.empty()) change.map = io::read_env_map(options.map, Orientation::kOpenExr, options.limits);
  if (const std::string fault = change.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  const pipeline::Estimator estimator(estimate_options(options));
  const io::Photo photo = io::load_photo(options.inputs[0], options.limits);
  const pipeline::Estimate estimate = estimator.estimate(photo);
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}", warning);
  if (const std::string fault = change.fault_of(estimate); !fault.empty()) throw Error(ExitCode::kUsage, fault);
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
                   "again and again: put out this one of each face's main lights, 1 the strongest, 5 at most, or with "
                   "=SHARE, 0 to 1, so much of it; default: none")
      ->type_name("LIGHT[=SHARE]")
      ->allow_extra_args(false);
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
      "  faceprobe relight portrait.jpg --dim 1=0.5 --dim 2 -o softer.png\n"
      "  faceprobe relight portrait.jpg --map studio.hdr --turn 40 -o studio.png");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/outputs.h"
#include "json_line.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <memory>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "faceprobe-out";
  bool json = false;
};

void print_json(const std::string& source, const std::filesystem::path& folder, const highlight::Layers& layers) {
  print_json_line({{"source", source},
                   {"width_px", layers.highlight.width()},
                   {"height_px", layers.highlight.height()},
                   {"highlight", (folder / "highlight.exr").string()},
                   {"diffuse", (folder / "diffuse.exr").string()}});
}

int run(const Options& options) {
  const pipeline::Estimator estimator(estimate_options(options));
  int code = 0;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    const int one = run_guarded([&] {
      const io::Photo photo = io::load_photo(options.inputs[i], options.limits);
      const highlight::Layers layers = estimator.separate(photo);
      const std::filesystem::path folder = folder_for(options.output, options, i);
      io::create_folder(folder);
      const io::Attributes attributes = pipeline::provenance(photo, estimator.options());
      io::write_picture(folder / "highlight.exr", layers.highlight, attributes);
      io::write_picture(folder / "diffuse.exr", layers.diffuse, attributes);
      if (options.json) print_json(options.inputs[i], folder, layers);
      spdlog::info("{}: wrote highlight.exr and diffuse.exr to {}", options.inputs[i], folder.string());
      return 0;
    });
    if (one != 0) code = options.inputs.size() > 1 ? static_cast<int>(ExitCode::kBatchFailures) : one;
  }
  return code;
}

}  // namespace

void add_separate(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("separate", "highlight and diffuse layer of a photo at its own size");
  add_inputs(*command, *options);
  command->add_option("-o,--output", options->output, "folder for highlight.exr and diffuse.exr")
      ->type_name("DIR")
      ->capture_default_str();
  add_face_options(*command, *options);
  command->add_flag("--json", options->json, "one JSON object per photo and line: the files that were written");
  command->footer(
      "The layers are linear, 1 = the photo's white. The highlight layer is black outside the faces' skin, where the\n"
      "diffuse layer is the photo itself.\n\nExample:\n  faceprobe separate portrait.jpg -o layers --separator yang");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

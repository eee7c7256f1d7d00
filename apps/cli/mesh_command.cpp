#include "commands.h"
#include "faceprobe/pipeline/found_meshes.h"
#include "json_line.h"
#include "progress.h"

#include <spdlog/spdlog.h>

#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string folder;
  int threads = 0;
  bool json = false;
};

int run(const Options& options) {
  Progress progress;
  const face::FaceFinder finder({.min_face_px = face::kSmallFacePx, .threads = options.threads});
  const pipeline::MeshCount count = pipeline::find_meshes(options.folder, finder, [&](int done, int total) {
    progress.show(done, total, fmt::format("{} of {} shards", done, total));
  });
  if (options.json) {
    print_json_line(
        {{"folder", options.folder}, {"views", count.views}, {"found", count.found}, {"seconds", progress.seconds()}});
  }
  if (count.views == 0) {
    spdlog::info("all meshes of {} were there", options.folder);
  } else {
    spdlog::info("a face was found in {} of {} views", count.found, count.views);
  }
  return 0;
}

}  // namespace

void add_mesh(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("mesh", "finds the face mesh in synthetic photos, for training the face network");
  command->add_option("FOLDER", options->folder, "folder that `faceprobe synth` wrote")->type_name("DIR")->required();
  command->add_option("--threads", options->threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end");
  command->footer("Example:\n  faceprobe mesh faces/train");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

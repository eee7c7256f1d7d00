#include "commands.h"
#include "faceprobe/pipeline/found_meshes.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string folder;
  int threads = 0;
};

int run(const Options& options) {
  const face::FaceFinder finder({.min_face_px = face::kSmallFacePx, .threads = options.threads});
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const pipeline::MeshCount count = pipeline::find_meshes(options.folder, finder, [terminal](int done, int total) {
    if (terminal) fmt::print(stderr, "\r{} of {} shards{}", done, total, done == total ? "\n" : "");
  });
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
  command->footer("Example:\n  faceprobe mesh faces/train");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

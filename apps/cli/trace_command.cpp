#include "commands.h"
#include "faceprobe/pipeline/traced_photos.h"
#include "json_line.h"
#include "progress.h"

#include <spdlog/spdlog.h>

#include <memory>
#include <string>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string folder;
  std::string weights;
  int count = pipeline::TraceRun{}.most;
  int threads = 0;
  bool json = false;
};

int run(const Options& options) {
  Progress progress;
  pipeline::TraceRun trace{.most = options.count, .options = {}};
  trace.options.weights = options.weights;
  trace.options.threads = options.threads;
  const pipeline::TraceCount count = pipeline::trace_photos(options.folder, trace, [&](int done, int total) {
    progress.show(done, total, fmt::format("{} of {} shards", done, total));
  });
  if (options.json) {
    print_json_line(
        {{"folder", options.folder}, {"photos", count.photos}, {"traced", count.traced}, {"seconds", progress.seconds()}});
  }
  if (count.photos == 0) {
    spdlog::info("all photos of {} had been read", options.folder);
  } else {
    spdlog::info("light could be read from {} of {} photos", count.traced, count.photos);
  }
  return 0;
}

}  // namespace

void add_trace(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("trace", "reads synthetic photos as an estimate does, for training the light prior");
  command
      ->add_option("FOLDER", options->folder, "folder that `faceprobe synth` wrote, with the meshes of `faceprobe mesh`")
      ->type_name("DIR")
      ->required();
  command->add_option("--count", options->count, "photos to read, spread evenly over the data")
      ->capture_default_str()
      ->check(CLI::Range(1, 100'000'000));
  command
      ->add_option("--weights", options->weights,
                   "weights of the face network; default: those that come with the program")
      ->type_name("FILE");
  command->add_option("--threads", options->threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end");
  command->footer("Example:\n  faceprobe trace faces/train --count 12000");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

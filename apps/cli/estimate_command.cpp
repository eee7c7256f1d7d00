#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/report.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "faceprobe-out";
  std::string orientation = "openexr";
  bool json = false;
  bool timings = false;
  bool same_light = false;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void print_timings(double start_s, double load_s, const pipeline::Estimate& estimate, double write_s) {
  std::fprintf(stderr, "%-24s %8s\n", "stage", "ms");
  double total = start_s + load_s + write_s;
  std::fprintf(stderr, "%-24s %8.1f\n", "load models", 1e3 * start_s);
  std::fprintf(stderr, "%-24s %8.1f\n", "read photo", 1e3 * load_s);
  for (const pipeline::StageTime& stage : estimate.timings) {
    std::fprintf(stderr, "%-24s %8.1f\n", stage.stage.c_str(), 1e3 * stage.seconds);
    total += stage.seconds;
  }
  std::fprintf(stderr, "%-24s %8.1f\n", "write files", 1e3 * write_s);
  std::fprintf(stderr, "%-24s %8.1f\n", "total", 1e3 * total);
}

void write_map(const std::string& path, const EnvMap& map, Orientation orientation, io::Attributes attributes) {
  attributes["faceprobe:map_columns"] = pipeline::orientation_name(orientation);
  io::write_env_map(path, map, orientation, attributes);
}

// What all photos say of their one light, and which these were.
struct Burst {
  std::vector<pipeline::FaceEvidence> faces;
  std::vector<pipeline::JointPhoto> photos;
};

void write_same_light(const Burst& burst, const pipeline::Estimator& estimator, const Options& options,
                      const pipeline::OutputOptions& how) {
  const pipeline::LightResult light = estimator.joint(burst.faces);
  if (is_picture_output(options.output)) {
    write_map(options.output, light.environment, how.orientation, pipeline::provenance(estimator.options()));
    spdlog::info("{} faces in one light, wrote {}", burst.faces.size(), options.output);
  } else {
    const std::filesystem::path folder = std::filesystem::path(options.output) / "joint";
    const auto files = pipeline::write_joint(folder, light, burst.photos, estimator.options(), how);
    spdlog::info("{} faces in one light, wrote {} files to {}", burst.faces.size(), files.size(), folder.string());
  }
  if (options.json) std::fputs(pipeline::joint_report_json(light, burst.photos, estimator.options()).c_str(), stdout);
}

int run(const Options& options) {
  const bool map_only = is_picture_output(options.output);
  if (map_only && options.inputs.size() > 1 && !options.same_light) {
    throw Error(ExitCode::kUsage, "-o " + options.output + " names one map, but there are " +
                                      std::to_string(options.inputs.size()) +
                                      " photos; name a folder, or say --same-light if one light is in all of them.");
  }
  if (options.same_light && options.inputs.size() < 2)
    throw Error(ExitCode::kUsage, "--same-light is for several photos, found one; leave it out.");
  const pipeline::EstimateOptions wanted = estimate_options(options);
  pipeline::OutputOptions output;
  output.orientation = pipeline::orientation_from_name(options.orientation);
  Clock::time_point start = Clock::now();
  const pipeline::Estimator estimator(wanted);
  double models_s = seconds_since(start);
  int code = 0;
  Burst burst;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    // One bad photo among several does not cost the others theirs: the code is 8 then, the photo's own when it is alone.
    const int one = run_guarded([&] {
      start = Clock::now();
      const io::Photo photo = io::load_photo(options.inputs[i], options.limits);
      const double load_s = seconds_since(start);
      const pipeline::Estimate estimate = estimator.estimate(photo);
      for (const std::string& warning : estimate.warnings) spdlog::warn("{}: {}", options.inputs[i], warning);
      start = Clock::now();
      if (options.same_light) {
        for (const pipeline::FaceEstimate& face : estimate.faces) burst.faces.push_back(pipeline::evidence_of(face));
        burst.photos.push_back({options.inputs[i], photo.sha256, estimate.faces.size()});
      }
      if (map_only && options.same_light) {
        spdlog::info("{}: {} face(s)", options.inputs[i], estimate.faces.size());
      } else if (map_only) {
        write_map(options.output, estimate.faces[estimate.largest].environment, output.orientation,
                  pipeline::provenance(photo, estimator.options()));
        spdlog::info("{}: {} face(s), wrote {}", options.inputs[i], estimate.faces.size(), options.output);
      } else {
        const std::string folder = folder_for(options.output, options, i);
        const auto files =
            pipeline::write_outputs(folder, estimate, photo, estimator.options(), options.inputs[i], output);
        spdlog::info("{}: {} face(s), wrote {} files to {}", options.inputs[i], estimate.faces.size(), files.size(),
                     folder);
      }
      if (options.timings) print_timings(models_s, load_s, estimate, seconds_since(start));
      models_s = 0;
      if (options.json) {
        std::fputs(pipeline::report_json(estimate, photo, estimator.options(), options.inputs[i]).c_str(), stdout);
      }
      return 0;
    });
    if (one != 0) code = options.inputs.size() > 1 ? static_cast<int>(ExitCode::kBatchFailures) : one;
  }
  if (!burst.faces.empty()) write_same_light(burst, estimator, options, output);
  return code;
}

}  // namespace

void add_estimate(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("estimate", "the light on the faces of a photo, as maps, layers and lights");
  add_inputs(*command, *options);
  command
      ->add_option("-o,--output", options->output,
                   "folder for everything, or NAME.exr/.hdr/.png for the largest face's map alone")
      ->type_name("PATH")
      ->capture_default_str();
  command->add_flag("--json", options->json, "print the report on stdout; of --same-light the one of all photos last");
  command->add_flag("--timings", options->timings, "print a table of stage times on stderr");
  command->add_flag("--same-light", options->same_light,
                    "the photos are of one camera, place and light, as a burst is: also one map of all their faces");
  command->add_option("--orient", options->orientation, "how the columns of the maps are laid out: for which program")
      ->type_name("{openexr,three,blender,debevec}")
      ->capture_default_str();
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->footer(
      "The folder gets the environment map (environment.exr, .hdr and a .png to look at) with its confidence, scenes\n"
      "for USD and Blender, the layers of the face, overview.png, and report.json with pose, spherical harmonics and\n"
      "main lights. Several faces get folders of their own, face_1, face_2, ... from left to right, beside joint, the\n"
      "light of all; several photos get folders of their names, and with --same-light one more, joint.\n\n"
      "Examples:\n  faceprobe estimate portrait.jpg -o out\n  faceprobe estimate portrait.jpg -o light.exr --orient "
      "blender\n"
      "  faceprobe estimate a.jpg b.jpg -o out --json > reports.json\n"
      "  faceprobe estimate burst_*.jpg --same-light -o light.exr");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

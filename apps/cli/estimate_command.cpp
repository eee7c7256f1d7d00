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
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "faceprobe-out";
  std::string orientation = "openexr";
  bool json = false;
  bool timings = false;
  bool same_light = false;
  bool same_person = false;
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

// What is to be done with each photo, and with what.
struct Task {
  const Options& options;
  const pipeline::Estimator& estimator;
  pipeline::OutputOptions output;
  bool map_only = false;
};

void check(const Options& options, bool map_only) {
  if (options.same_light && options.same_person) {
    throw Error(
        ExitCode::kUsage,
        "--same-light says that one light is in all photos, --same-person that each has its own; leave one out.");
  }
  if (map_only && options.inputs.size() > 1 && !options.same_light) {
    throw Error(ExitCode::kUsage, "-o " + options.output + " names one map, but there are " +
                                      std::to_string(options.inputs.size()) +
                                      " photos; name a folder, or say --same-light if one light is in all of them.");
  }
  for (const auto& [asked, name] :
       {std::pair(options.same_light, "--same-light"), std::pair(options.same_person, "--same-person")}) {
    if (asked && options.inputs.size() < 2)
      throw Error(ExitCode::kUsage, std::string(name) + " is for several photos, found one; leave it out.");
  }
}

// The files and the report of one photo. `models_s`, `load_s`: spent before, for the table of times.
void write_photo(const Task& task, std::size_t input, const io::Photo& photo, const pipeline::Estimate& estimate,
                 double models_s, double load_s) {
  const Options& options = task.options;
  const std::string& name = options.inputs[input];
  const Clock::time_point start = Clock::now();
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}: {}", name, warning);
  if (task.map_only && options.same_light) {
    spdlog::info("{}: {} face(s)", name, estimate.faces.size());
  } else if (task.map_only) {
    write_map(options.output, estimate.faces[estimate.largest].environment, task.output.orientation,
              pipeline::provenance(photo, task.estimator.options()));
    spdlog::info("{}: {} face(s), wrote {}", name, estimate.faces.size(), options.output);
  } else {
    const std::string folder = folder_for(options.output, options, input);
    const auto files = pipeline::write_outputs(folder, estimate, photo, task.estimator.options(), name, task.output);
    spdlog::info("{}: {} face(s), wrote {} files to {}", name, estimate.faces.size(), files.size(), folder);
  }
  if (options.timings) print_timings(models_s, load_s, estimate, seconds_since(start));
  if (options.json) std::fputs(pipeline::report_json(estimate, photo, task.estimator.options(), name).c_str(), stdout);
}

// Each photo by itself, and with --same-light the light of all of them.
int run_each(const Task& task, double models_s) {
  const Options& options = task.options;
  int code = 0;
  Burst burst;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    // One bad photo among several does not cost the others theirs: the code is 8 then, the photo's own when it is alone.
    const int one = run_guarded([&] {
      const Clock::time_point start = Clock::now();
      const io::Photo photo = io::load_photo(options.inputs[i], options.limits);
      const double load_s = seconds_since(start);
      const pipeline::Estimate estimate = task.estimator.estimate(photo);
      if (options.same_light) {
        for (const pipeline::FaceEstimate& face : estimate.faces) burst.faces.push_back(pipeline::evidence_of(face));
        burst.photos.push_back({options.inputs[i], photo.sha256, estimate.faces.size()});
      }
      write_photo(task, i, photo, estimate, models_s, load_s);
      models_s = 0;
      return 0;
    });
    if (one != 0) code = options.inputs.size() > 1 ? static_cast<int>(ExitCode::kBatchFailures) : one;
  }
  if (!burst.faces.empty()) write_same_light(burst, task.estimator, options, task.output);
  return code;
}

// All photos before any is written: each one's light depends on what the others say of the skin. Pictures of many would not fit into memory, so
// each is read again.
int run_same_person(const Task& task, double models_s) {
  const Options& options = task.options;
  std::vector<std::size_t> inputs;
  std::vector<pipeline::Estimate> estimates;
  int code = 0;
  const auto guarded = [&](const std::function<void()>& work) {
    const int one = run_guarded([&] {
      work();
      return 0;
    });
    if (one != 0) code = static_cast<int>(ExitCode::kBatchFailures);
  };
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    guarded([&] {
      estimates.push_back(task.estimator.estimate(io::load_photo(options.inputs[i], options.limits)));
      inputs.push_back(i);
    });
  }
  task.estimator.same_person(estimates);
  const auto shares = [](const pipeline::Estimate& e) { return e.faces[e.largest].same_person.has_value(); };
  const auto sharing = std::ranges::count_if(estimates, shares);
  spdlog::info("{} of {} photos share one person's skin", sharing, options.inputs.size());
  if (sharing < 2)
    spdlog::warn("--same-person: fewer than two photos show lit skin, so each light is its photo's own.");
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    guarded([&] {
      const Clock::time_point start = Clock::now();
      const io::Photo photo = io::load_photo(options.inputs[inputs[k]], options.limits);
      write_photo(task, inputs[k], photo, estimates[k], models_s, seconds_since(start));
      models_s = 0;
    });
  }
  return code;
}

int run(const Options& options) {
  const bool map_only = is_picture_output(options.output);
  check(options, map_only);
  const pipeline::EstimateOptions wanted = estimate_options(options);
  pipeline::OutputOptions output;
  output.orientation = pipeline::orientation_from_name(options.orientation);
  const Clock::time_point start = Clock::now();
  const pipeline::Estimator estimator(wanted);
  const double models_s = seconds_since(start);
  const Task task{options, estimator, output, map_only};
  return options.same_person ? run_same_person(task, models_s) : run_each(task, models_s);
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
  command->add_flag("--same-person", options->same_person,
                    "the photos are of one person, each in a light of its own: one skin for all of them");
  command->add_option("--orient", options->orientation, "how the columns of the maps are laid out: for which program")
      ->type_name("{openexr,three,blender,debevec}")
      ->capture_default_str();
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->footer(
      "The folder gets the environment map (environment.exr, .hdr and a .png to look at) with its confidence, scenes\n"
      "for USD and Blender, the layers of the face, overview.png, and report.json with pose, spherical harmonics and\n"
      "main lights. Several faces get folders of their own, face_1, face_2, ... from left to right, beside joint, the\n"
      "light of all; several photos get folders of their names, and with --same-light one more, joint.\n"
      "With --same-person the largest face of each photo is taken for one person, whose albedo and gloss the photos\n"
      "then agree on: what one photo took for skin and was light, the others correct.\n\n"
      "Examples:\n  faceprobe estimate portrait.jpg -o out\n  faceprobe estimate portrait.jpg -o light.exr --orient "
      "blender\n"
      "  faceprobe estimate a.jpg b.jpg -o out --json > reports.json\n"
      "  faceprobe estimate burst_*.jpg --same-light -o light.exr\n"
      "  faceprobe estimate garden.jpg kitchen.jpg --same-person -o out");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

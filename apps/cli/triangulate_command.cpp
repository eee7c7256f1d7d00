#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/room.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "faceprobe-room";
  bool json = false;
};

int run(const Options& options) {
  if (options.inputs.size() != 1)
    throw Error(ExitCode::kUsage,
                "A room is triangulated from one photo, found " + std::to_string(options.inputs.size()) + ".");
  const pipeline::Estimator estimator(estimate_options(options));
  const io::Photo photo = io::load_photo(options.inputs[0], options.limits);
  const pipeline::Estimate estimate = estimator.estimate(photo);
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}", warning);
  const pipeline::Room room = pipeline::find_lamps(estimate);
  const std::filesystem::path folder = options.output;
  pipeline::write_room(folder, room, estimate, options.inputs[0]);
  std::size_t near = 0;
  for (const lighting::Lamp& lamp : room.lamps) near += lamp.near ? 1 : 0;
  spdlog::info("{} faces, {} lamps in the room, {} lights from afar; wrote {}", room.faces.size(), near,
               room.lamps.size() - near, folder.string());
  if (options.json) std::fputs(pipeline::room_json(room, options.inputs[0]).c_str(), stdout);
  return 0;
}

}  // namespace

void add_triangulate(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("triangulate", "where the lamps stand, from a photo of several faces");
  add_inputs(*command, *options);
  command->add_option("-o,--output", options->output, "folder for room.json, room.gltf and room.png")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--json", options->json, "print room.json on stdout");
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->footer("Example:\n  faceprobe triangulate party.jpg -o room");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

#include "commands.h"
#include "faceprobe/assets/named_model.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/insertion.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/render/shapes.h"
#include "option_tree.h"
#include "progress.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

constexpr int kPreviewPx = 640;
constexpr int kPreviewSamples = 16;

struct Options : SharedOptions {
  std::string output = "faceprobe-insert";
  std::string object = "pot";
  std::string material, kind, colour;
  std::optional<float> roughness, ior;
  std::string matte;
  std::vector<double> at_px;
  std::optional<float> beside_m, depth_m, height_m;
  std::optional<double> horizon_px;
  double turn_deg = 0;
  bool no_ground = false;
  bool preview = false;
  bool json = false;
  int samples = insert::Options{}.render.samples;
  float noise = insert::Options{}.render.noise;
  std::uint64_t seed = 1;
};

Image matte_of(const Options& options) {
  return options.matte.empty() ? Image() : pipeline::matte_from(io::load_photo(options.matte, options.limits));
}

render::MaterialChange change_of(const Options& options) {
  render::MaterialChange change{.roughness = options.roughness, .ior = options.ior};
  if (!options.kind.empty()) change.kind = render::material_kind_from_name(options.kind);
  if (!options.colour.empty()) change.colour = render::colour_from(options.colour);
  return change;
}

int run(const Options& options) {
  if (options.inputs.size() != 1)
    throw Error(ExitCode::kUsage,
                "An object is put into one photo, found " + std::to_string(options.inputs.size()) + ".");
  // Before the photo: a typing error should not cost an estimate.
  const bool picture_alone = is_picture_output(options.output);
  assets::LoadedModel object = assets::model_named(options.object, options.material, change_of(options));
  for (const std::string& warning : object.warnings) spdlog::warn("{}: {}", options.object, warning);
  pipeline::InsertionOptions where{.beside_m = options.beside_m,
                                   .depth_m = options.depth_m,
                                   .height_m = options.height_m,
                                   .turn_deg = static_cast<float>(options.turn_deg),
                                   .horizon_px = options.horizon_px,
                                   .ground = !options.no_ground,
                                   .matte = matte_of(options)};
  if (!options.at_px.empty()) where.at_px = Eigen::Vector2d(options.at_px[0], options.at_px[1]);
  insert::Options how;
  how.render.samples = options.preview ? kPreviewSamples : options.samples;
  how.render.noise = options.noise;
  how.render.seed = options.seed;
  how.render.threads = options.threads;
  for (const std::string& fault : {where.validate(), how.validate()}) {
    if (!fault.empty()) throw Error(ExitCode::kUsage, fault);
  }
  const pipeline::Estimator estimator(estimate_options(options));
  io::Photo photo = io::load_photo(options.inputs[0], options.limits);
  const pipeline::Estimate estimate = estimator.estimate(photo);
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}", warning);
  insert::Scene scene = pipeline::scene_for(photo, estimate, std::move(object.model), where);
  if (options.preview) insert::shrink(photo.linear, scene, kPreviewPx);
  Progress progress;
  how.render.progress = [&](float share) {
    progress.show(static_cast<double>(share), 1, fmt::format("drawing: {:.0f} %", 100 * share));
    return true;
  };
  const insert::Insertion done = insert::insert_model(photo.linear, scene, how);
  progress.clear();
  const std::filesystem::path output = options.output;
  if (picture_alone) {
    io::write_picture(output, done.picture);
    spdlog::info("wrote {}", options.output);
  } else {
    const auto files = pipeline::write_insertion(output, done, scene, options.inputs[0], options.object);
    spdlog::info("wrote {} files to {}", files.size(), options.output);
  }
  if (options.json)
    std::fputs(pipeline::insertion_json(done, scene, options.inputs[0], options.object).c_str(), stdout);
  return 0;
}

}  // namespace

void add_insert(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("insert", "a virtual object into a photo, in the light of the faces");
  add_inputs(*command, *options);
  command
      ->add_option("-o,--output", options->output, "folder for everything, or NAME.png/.exr/.hdr for the picture alone")
      ->type_name("PATH")
      ->capture_default_str();
  command
      ->add_option("--object", options->object,
                   "what to put in: one of these shapes, or an OBJ, PLY, STL, glTF or GLB file")
      ->type_name("{" + joined(render::shape_names(), ",") + "}|FILE")
      ->capture_default_str();
  command->add_option("--material", options->material, "what all of it is made of; default: the object's own")
      ->type_name("{" + joined(render::material_preset_names(), ",") + "}");
  command
      ->add_option("--colour", options->colour,
                   "its colour: R,G,B of linear light, 0 to 1, or #rrggbb as on web pages; default: the material's own")
      ->type_name("R,G,B|#RRGGBB");
  command->add_option("--kind", options->kind, "how its surface answers light; default: as the material does")
      ->type_name("{" + joined(render::material_kind_names(), ",") + "}");
  command->add_option("--roughness", options->roughness,
                      "of metal and plastic, from 0, a mirror, to 1; default: the material's own");
  command->add_option("--ior", options->ior,
                      "index of refraction of plastic and glass, from 1 to 3; default: the material's own");
  command
      ->add_option("--at", options->at_px,
                   "pixel of the photo, X and Y, where its foot stands; default: the lower corner with more room")
      ->expected(2);
  command->add_option(
      "--beside", options->beside_m,
      "in place of --at: metres to the right of the largest face, below 0 to its left, as far away as the "
      "face and low in the picture; default: not beside it");
  command->add_option(
      "--distance", options->depth_m,
      "metres from the camera to it; default: the largest face's with --beside, else three quarters of it");
  command->add_option("--height", options->height_m,
                      "its height in metres; default: its longer side takes 35 % of the picture's shorter one");
  command->add_option("--turn", options->turn_deg, "degrees about its own axis, its front to the right")
      ->capture_default_str();
  command->add_option("--horizon", options->horizon_px,
                      "height of the horizon in the photo, pixels from the top; default: from the heads");
  command->add_flag("--no-ground", options->no_ground, "it floats: nothing takes its shadow");
  command
      ->add_option("--matte", options->matte,
                   "picture of the photo's size, white where a person stands before far things; default: what is known "
                   "of the faces")
      ->type_name("FILE");
  command->add_flag("--preview", options->preview,
                    "a quick look, its longer side " + std::to_string(kPreviewPx) + " pixels at most");
  command->add_option("--samples", options->samples, "most rays per pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--noise", options->noise, "stop where the picture is this quiet; 0: never before --samples")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "the same seed gives the same rays")->capture_default_str();
  command->add_flag("--json", options->json, "print what stands where on stdout");
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->footer(
      "Takes one photo. The folder gets composite.png and, linear, composite.exr, the object alone with alpha, its\n"
      "shadow, depth and normals, and insert.json, which says what stands where.\n\n"
      "Examples:\n  faceprobe insert portrait.jpg -o with_pot.png\n"
      "  faceprobe insert portrait.jpg --object bunny.ply --material silver --height 0.15 --preview -o look.png\n"
      "  faceprobe insert portrait.jpg --object sphere --material plastic --colour '#c02010' --beside 0.25 -o "
      "ball.png\n"
      "  faceprobe insert portrait.jpg --object robot.glb --at 300 1180 --turn 30 -o out");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

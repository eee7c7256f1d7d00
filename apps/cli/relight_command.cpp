#include "commands.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/lighting/main_lights.h"
#include "faceprobe/pipeline/relight.h"
#include "shared_options.h"

#include <spdlog/spdlog.h>

#include <Eigen/Geometry>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options : SharedOptions {
  std::string output = "relit.png";
  std::string map;
  double turn_deg = 0;
  int dim = 0;
  double exposure = 0;
};

// The light that was asked for, on the cells of the face's own.
Eigen::MatrixX3f light_of(const Options& options, const pipeline::FaceEstimate& face,
                          const pipeline::Estimator& estimator, const EnvMap& given) {
  const lighting::Light& own = face.light;
  const SphereGrid grid(estimator.options().solve.nside);
  Eigen::MatrixX3f light = own.radiance;
  if (options.dim > 0)
    light = lighting::without_main_lights(light, grid, options.dim, estimator.options().main_lights, own.confidence);
  if (given.width() > 0) {
    // A map has no unit that a photo shares: it gets the energy of the light that it replaces.
    const double energy = own.radiance.cast<double>().sum() * grid.cell_solid_angle();
    light = grid_from_env_map(given, grid) * static_cast<float>(energy / given.integral().sum());
  }
  if (options.turn_deg != 0) {
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(radians(options.turn_deg)), Eigen::Vector3f::UnitY()).toRotationMatrix();
    light = grid_from_env_map(rotate(env_map_from_grid(light, grid, 256, 128), turn), grid);
  }
  return light * static_cast<float>(std::exp2(options.exposure));
}

int run(const Options& options) {
  if (options.inputs.size() != 1)
    throw Error(ExitCode::kUsage, "One photo is relit at a time, found " + std::to_string(options.inputs.size()) + ".");
  if (options.map.empty() && options.turn_deg == 0 && options.dim == 0 && options.exposure == 0)
    throw Error(ExitCode::kUsage,
                "The light would stay as it is; say --map FILE, --dim N, --turn DEGREES or --exposure STOPS.");
  if (!options.map.empty() && options.dim > 0)
    throw Error(ExitCode::kUsage, "--dim is for the photo's own lights; leave it or --map out.");
  if (!is_picture_output(options.output))
    throw Error(ExitCode::kUsage, "The relit photo is one picture; name it -o NAME.png, .exr or .hdr.");
  const EnvMap given =
      options.map.empty() ? EnvMap() : io::read_env_map(options.map, Orientation::kOpenExr, options.limits);
  if (given.width() > 0 && !(given.integral().sum() > 0))
    throw Error(ExitCode::kInput, options.map + " holds no light; choose another map.");
  const pipeline::Estimator estimator(estimate_options(options));
  const io::Photo photo = io::load_photo(options.inputs[0], options.limits);
  const pipeline::Estimate estimate = estimator.estimate(photo);
  for (const std::string& warning : estimate.warnings) spdlog::warn("{}", warning);
  Image picture = photo.linear;
  for (const pipeline::FaceEstimate& face : estimate.faces)
    pipeline::relight(picture, face, light_of(options, face, estimator, given), {.threads = options.threads});
  io::write_picture(options.output, picture);
  spdlog::info("{} face(s), wrote {}", estimate.faces.size(), options.output);
  return 0;
}

}  // namespace

void add_relight(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("relight", "a photo's faces in another light: a preview, of the faces alone");
  add_inputs(*command, *options);
  command->add_option("-o,--output", options->output, "NAME.png, .exr or .hdr")->capture_default_str();
  command->add_option("--map", options->map,
                      "lat-long .exr or .hdr map that lights the faces instead, as strong as their own light");
  command->add_option("--dim", options->dim, "put out this many of the photo's main lights, the strongest first")
      ->check(CLI::Range(1, 5));
  command->add_option("--turn", options->turn_deg,
                      "turn the light about the vertical, degrees, to the right seen from above the photo");
  command->add_option("--exposure", options->exposure, "stops brighter or darker");
  add_face_options(*command, *options);
  add_solver_options(*command, *options);
  command->footer(
      "Examples:\n  faceprobe relight portrait.jpg --dim 1 -o without_sun.png\n"
      "  faceprobe relight portrait.jpg --map studio.hdr --turn 40 -o studio.png");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli

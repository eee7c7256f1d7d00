// relight.

#include "faceprobe/pipeline/relight.h"

#include "arrays.h"
#include "bind.h"
#include "estimate.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/picture_file.h"
#include "options.h"

#include <Eigen/Geometry>
#include <cmath>

namespace faceprobe::python {

namespace {

using MapSource = std::variant<std::shared_ptr<EnvMap>, std::filesystem::path>;

struct Change {
  EnvMap map;  // empty = the face's own light
  int dim = 0;
  double turn_deg = 0;
  double exposure = 0;
};

void check(const Change& change, bool has_map) {
  constexpr int kMostLights = 5;
  constexpr double kMostStops = 30;
  if (change.dim < 0 || change.dim > kMostLights)
    throw Error(ExitCode::kUsage, "dim must be from 0 to 5 lights, found " + std::to_string(change.dim) + ".");
  if (!std::isfinite(change.turn_deg)) throw Error(ExitCode::kUsage, "turn must be a number of degrees.");
  if (!(std::abs(change.exposure) <= kMostStops))
    throw Error(ExitCode::kUsage,
                "exposure must be from -30 to 30 stops, found " + std::to_string(change.exposure) + ".");
  if (!has_map && change.dim == 0 && change.turn_deg == 0 && change.exposure == 0)
    throw Error(ExitCode::kUsage, "The light would stay as it is; give map, dim, turn or exposure.");
  if (has_map && change.dim > 0)
    throw Error(ExitCode::kUsage, "dim is for the photo's own lights; leave it or map out.");
}

// The light that was asked for, on the cells of the face's own.
Eigen::MatrixX3f light_of(const Change& change, const pipeline::FaceEstimate& face,
                          const pipeline::EstimateOptions& options) {
  constexpr int kTurnWidth = 256;
  const lighting::Light& own = face.light;
  const SphereGrid grid(options.solve.nside);
  Eigen::MatrixX3f light = own.radiance;
  if (change.dim > 0)
    light = lighting::without_main_lights(light, grid, change.dim, options.main_lights, own.confidence);
  if (change.map.width() > 0) {
    // A map has no unit that a photo shares: it gets the energy of the light that it replaces.
    const double energy = own.radiance.cast<double>().sum() * grid.cell_solid_angle();
    light = grid_from_env_map(change.map, grid) * static_cast<float>(energy / change.map.integral().sum());
  }
  if (change.turn_deg != 0) {
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(radians(change.turn_deg)), Eigen::Vector3f::UnitY()).toRotationMatrix();
    light = grid_from_env_map(rotate(env_map_from_grid(light, grid, kTurnWidth, kTurnWidth / 2), turn), grid);
  }
  return light * static_cast<float>(std::exp2(change.exposure));
}

EnvMap map_of(const MapSource& source) {
  const auto* path = std::get_if<std::filesystem::path>(&source);
  EnvMap map = path == nullptr ? *std::get<std::shared_ptr<EnvMap>>(source) : io::read_env_map(*path);
  if (!(map.integral().sum() > 0)) throw Error(ExitCode::kInput, "The map holds no light; choose another one.");
  return map;
}

py::array_t<float> relight(const py::object& photo, const std::optional<MapSource>& map, int dim, double turn,
                           double exposure, int threads, EstimatedPtr estimated) {
  check_threads(threads);
  Change change{.map = {}, .dim = dim, .turn_deg = turn, .exposure = exposure};
  check(change, map.has_value());
  PhotoSource source(photo);
  std::shared_ptr<Image> picture;
  {
    const py::gil_scoped_release release;
    if (map) change.map = map_of(*map);
    const std::string name = source.name();
    io::Photo loaded = std::move(source).load();
    if (estimated) {
      check_same_size(loaded, *estimated);
    } else {
      pipeline::EstimateOptions options;
      options.threads = threads;
      estimated = TurnTaker(std::move(options)).estimate(loaded, name);
    }
    picture = std::make_shared<Image>(std::move(loaded.linear));
    for (const pipeline::FaceEstimate& face : estimated->estimate.faces)
      pipeline::relight(*picture, face, light_of(change, face, estimated->options), {.threads = threads});
  }
  return view(picture, *picture);
}

}  // namespace

void bind_relight(py::module_& module) {
  module.def(
      "relight", &relight, py::arg("photo"), py::kw_only(), py::arg("map") = py::none(), py::arg("dim") = 0,
      py::arg("turn") = 0.0, py::arg("exposure") = 0.0, py::arg("threads") = 0, py::arg("estimate") = py::none(),
      R"(A photo's faces in another light: a preview, of the faces alone. Returns float32 (H, W, 3), linear Rec.709.

photo: as for estimate().
map: EnvMap, or the path of an .exr or .hdr map, that lights the faces instead, as strong as their own light.
dim: put out this many of the photo's main lights, the strongest first, at most 5.
turn: turn the light about the vertical, degrees, to the right seen from above the photo.
exposure: stops brighter or darker.
threads: 0 = all.
estimate: the photo's Estimate; else one is made with default options.

Raises NoFaceError, InputError, UsageError, ModelError.)");
}

}  // namespace faceprobe::python

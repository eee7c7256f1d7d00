// relight.

#include "faceprobe/pipeline/relight.h"

#include "arrays.h"
#include "bind.h"
#include "estimate.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "options.h"

#include <map>
#include <variant>
#include <vector>

namespace faceprobe::python {

namespace {

using MapSource = std::variant<std::shared_ptr<EnvMap>, std::filesystem::path>;

// Raises TypeError unless it is None, an EnvMap or a path.
std::optional<MapSource> map_source(const py::object& map) {
  if (map.is_none()) return {};
  if (py::isinstance<EnvMap>(map)) return map.cast<std::shared_ptr<EnvMap>>();
  py::detail::make_caster<std::filesystem::path> path;
  if (path.load(map, false)) return py::detail::cast_op<std::filesystem::path&>(path);
  throw py::type_error("map must be an EnvMap or a path, found " +
                       std::string(py::str(py::type::of(map).attr("__name__"))) +
                       "; of an array, EnvMap(array) makes one.");
}

EnvMap map_of(const MapSource& source) {
  const auto* path = std::get_if<std::filesystem::path>(&source);
  return path == nullptr ? *std::get<std::shared_ptr<EnvMap>>(source) : io::read_env_map(*path);
}

// A light, several, or lights with the share of each that goes.
using DimSource = std::variant<int, std::vector<int>, std::map<int, double>>;

std::vector<pipeline::DimmedLight> dimmed_lights(const std::optional<DimSource>& source) {
  std::vector<pipeline::DimmedLight> dim;
  if (!source) return dim;
  if (const auto* light = std::get_if<int>(&*source)) dim.push_back({.light = *light});
  if (const auto* lights = std::get_if<std::vector<int>>(&*source)) {
    for (const int light : *lights) dim.push_back({.light = light});
  }
  if (const auto* shares = std::get_if<std::map<int, double>>(&*source)) {
    for (const auto& [light, share] : *shares) dim.push_back({.light = light, .share = share});
  }
  return dim;
}

py::array_t<float> relight(const py::object& photo, const py::object& map, const std::optional<DimSource>& dim,
                           double turn, double exposure, int threads, EstimatedPtr estimated) {
  check_threads(threads);
  pipeline::LightChange change{.map = {}, .dim = dimmed_lights(dim), .turn_deg = turn, .exposure = exposure};
  const std::optional<MapSource> new_light = map_source(map);
  PhotoSource source(photo);
  std::shared_ptr<Image> picture;
  {
    const py::gil_scoped_release release;
    if (new_light) change.map = map_of(*new_light);
    if (const std::string fault = change.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
    const std::string name = source.name();
    io::Photo loaded = std::move(source).load();
    if (estimated) {
      check_same_size(loaded, *estimated);
    } else {
      pipeline::EstimateOptions options;
      options.threads = threads;
      estimated = TurnTaker(std::move(options)).estimate(loaded, name);
    }
    if (const std::string fault = change.fault_of(estimated->estimate); !fault.empty())
      throw Error(ExitCode::kUsage, fault);
    picture = std::make_shared<Image>(std::move(loaded.linear));
    for (const pipeline::FaceEstimate& face : estimated->estimate.faces)
      pipeline::relight(*picture, face, pipeline::changed_light(face, change, estimated->options), {.threads = threads});
  }
  return view(picture, *picture);
}

}  // namespace

void bind_relight(py::module_& module) {
  module.def(
      "relight", &relight, py::arg("photo"), py::kw_only(), py::arg("map") = py::none(), py::arg("dim") = py::none(),
      py::arg("turn") = 0.0, py::arg("exposure") = 0.0, py::arg("threads") = 0, py::arg("estimate") = py::none(),
      R"(A photo's faces in another light: a preview, of the faces alone. Returns float32 (H, W, 3), linear Rec.709.

photo: as for estimate().
map: EnvMap, or the path of an .exr or .hdr map, that lights the faces instead, as strong as their own light.
dim: put out this one of each face's main lights, 1 the strongest, at most 5; or several, as [1, 2]; or a share of each, as {1: 0.5, 2: 1}.
turn: turn the light about the vertical, degrees, to the right seen from above the photo.
exposure: stops brighter or darker.
threads: 0 = all.
estimate: the photo's Estimate; else one is made with default options.

Raises NoFaceError, InputError, UsageError, ModelError.)");
}

}  // namespace faceprobe::python

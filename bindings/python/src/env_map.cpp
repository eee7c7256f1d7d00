// EnvMap and read_env_map.

#include "faceprobe/core/env_map.h"

#include "arrays.h"
#include "bind.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/outputs.h"
#include "options.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace faceprobe::python {

namespace {

using MapPtr = std::shared_ptr<EnvMap>;

MapPtr map_from(const py::array& radiance) {
  Image image = image_from<float>(radiance, "radiance", 3);
  if (!std::ranges::all_of(image.values(), [](float value) { return std::isfinite(value) && value >= 0; }))
    throw py::value_error("radiance holds values that are negative, infinite or not numbers, which no light is.");
  return std::make_shared<EnvMap>(std::move(image));
}

py::array_t<float> sample(const EnvMap& map, const py::array& directions) {
  const Eigen::MatrixX3f rows = rows_of_three(directions, "directions");
  Eigen::MatrixX3f found(rows.rows(), 3);
  {
    const py::gil_scoped_release release;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) found.row(i) = map.sample(rows.row(i).transpose()).transpose();
  }
  return table(found);
}

void save(const EnvMap& map, const std::filesystem::path& path, const std::string& orientation) {
  const Orientation columns = pipeline::orientation_from_name(orientation, "orientation");
  const py::gil_scoped_release release;
  io::write_env_map(path, map, columns);
}

MapPtr read(const std::filesystem::path& path, const std::string& orientation) {
  const Orientation columns = pipeline::orientation_from_name(orientation, "orientation");
  const py::gil_scoped_release release;
  return std::make_shared<EnvMap>(io::read_env_map(path, columns));
}

}  // namespace

void bind_env_map(py::module_& module) {
  py::class_<EnvMap, MapPtr> type(module, "EnvMap",
                                  R"(A lat-long environment map: radiance, linear Rec.709, on a relative scale.

Row 0 is up, the centre column is +z (behind the photographer), a quarter of the width is +x (the right of the photo).)");
  call_public(type);
  type.def(py::init(&map_from), py::arg("radiance"),
           "radiance: float32 (N, 2 N, 3), C-contiguous, not negative; copied.")
      .def_property_readonly("width", &EnvMap::width, "Columns.")
      .def_property_readonly("height", &EnvMap::height, "Rows, half as many as columns.")
      .def(
          "to_numpy", [](const MapPtr& map) { return view(map, map->radiance()); },
          "Radiance, float32 (height, width, 3): a read-only view without a copy, valid however long it is kept.")
      .def("sample", &sample, py::arg("directions"), R"(Radiance that comes from these directions, bilinear.

directions: float32 (N, 3), camera frame, from the face to the light, of any length above 0. Returns float32 (N, 3).)")
      .def("save", &save, py::arg("path"), py::arg("orientation") = "openexr",
           R"(Writes NAME.exr, NAME.hdr, or a tone-mapped preview NAME.png, whole or not at all.

orientation: whose columns the file has: "openexr" (also USD, Mitsuba), "three", "blender", "debevec".)")
      .def("__repr__", [](const EnvMap& map) {
        return "<faceprobe.EnvMap " + std::to_string(map.width()) + " x " + std::to_string(map.height()) + ">";
      });
  module.def("read_env_map", &read, py::arg("path"), py::arg("orientation") = "openexr",
             R"(The lat-long map of an .exr or .hdr file, twice as wide as high.

orientation: whose columns the file has, as in EnvMap.save. Raises InputError.)");
}

}  // namespace faceprobe::python

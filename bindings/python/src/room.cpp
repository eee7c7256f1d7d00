// triangulate, Lamp.

#include "faceprobe/pipeline/room.h"

#include "arrays.h"
#include "bind.h"
#include "estimate.h"

#include <pybind11/stl.h>

namespace faceprobe::python {

namespace {

using lighting::Lamp;

std::vector<std::pair<int, int>> sightings_of(const Lamp& lamp) {
  std::vector<std::pair<int, int>> seen;
  for (const lighting::Sighting& sighting : lamp.seen) seen.emplace_back(sighting.face, sighting.light);
  return seen;
}

// Nothing is known of where a distant lamp stands.
py::object if_near(const Lamp& lamp, py::object value) { return lamp.near ? std::move(value) : py::none(); }

std::vector<Lamp> lamps_of(const Estimated& estimated) {
  const py::gil_scoped_release release;
  return pipeline::find_lamps(estimated.estimate).lamps;
}

}  // namespace

void bind_room(py::module_& module) {
  py::class_<Lamp> type(module, "Lamp", "A lamp that several faces of a photo see.");
  call_public(type);
  type.def_readonly("near", &Lamp::near, "Whether the faces tell where it stands; else it is distant.")
      .def_property_readonly(
          "position_m", [](const Lamp& l) { return if_near(l, table(l.position_m)); },
          "float64 (3,), metres, camera frame; None of a distant lamp.")
      .def_property_readonly(
          "covariance_m2", [](const Lamp& l) { return if_near(l, table(l.covariance_m2)); },
          "float64 (3, 3): of position_m, square metres; None of a distant lamp.")
      .def_property_readonly(
          "direction", [](const Lamp& l) { return table(l.direction); },
          "float64 (3,): unit vector from the faces' middle to the lamp, camera frame.")
      .def_property_readonly(
          "colour", [](const Lamp& l) { return table(l.colour); }, "float64 (3,): linear Rec.709 of luminance 1.")
      .def_readonly("intensity", &Lamp::intensity,
                    "Irradiance times squared distance of a near lamp, irradiance of a distant one.")
      .def_readonly("miss_deg", &Lamp::miss_deg, "How far the faces' lights are from where they should be seen, rms.")
      .def_property_readonly("seen", &sightings_of,
                             "list of (face, light): indices into Estimate.faces and Face.lights.")
      .def("__repr__", [](const Lamp& l) {
        return std::string("<faceprobe.Lamp, ") + (l.near ? "near" : "distant") + ", seen by " +
               std::to_string(l.seen.size()) + " faces>";
      });
  module.def("triangulate", &lamps_of, py::arg("estimate"),
             R"(Where the lamps stand that several faces of a photo see: list of Lamp, those that most faces see first.

Raises NoFaceError for an Estimate of fewer than two faces.)");
}

}  // namespace faceprobe::python

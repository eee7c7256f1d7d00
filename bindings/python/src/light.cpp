// What one light estimate amounts to: maps, harmonics, main lights.

#include "arrays.h"
#include "bind.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/pipeline/estimate.h"

#include <pybind11/stl.h>

#include <cstdio>
#include <memory>

namespace faceprobe::python {

namespace {

using lighting::MainLight;
using pipeline::LightResult;

std::string text_of(const MainLight& light) {
  char text[128];
  std::snprintf(text, sizeof text, "<faceprobe.Light at azimuth %.0f, elevation %.0f degrees, %.0f %% of the energy>",
                azimuth_deg(light.direction), elevation_deg(light.direction), 100 * light.share);
  return text;
}

}  // namespace

void bind_light(py::module_& module) {
  py::class_<MainLight> light(module, "Light", "One of the few lights that a person would name.");
  call_public(light);
  light
      .def_property_readonly(
          "direction", [](const MainLight& l) { return table(l.direction); },
          "float64 (3,): unit vector from the face to the light, camera frame (+x right, +y up, +z to the viewer).")
      .def_property_readonly(
          "azimuth_deg", [](const MainLight& l) { return azimuth_deg(l.direction); },
          "Positive to the right of the photo, 0 towards the viewer.")
      .def_property_readonly(
          "elevation_deg", [](const MainLight& l) { return elevation_deg(l.direction); }, "Positive up.")
      .def_property_readonly(
          "colour", [](const MainLight& l) { return table(l.colour); }, "float64 (3,): linear Rec.709 of luminance 1.")
      .def_readonly("irradiance", &MainLight::irradiance,
                    "Luminance x steradian above the surroundings, on a surface that faces the light.")
      .def_readonly("peak_radiance", &MainLight::peak_radiance, "Luminance of the brightest spot.")
      .def_readonly("solid_angle_sr", &MainLight::solid_angle_sr, "Size of an even disc with the same peak.")
      .def_readonly("share", &MainLight::share, "Of the whole map's energy, 0 to 1.")
      .def_readonly("direction_uncertainty_deg", &MainLight::direction_uncertainty_deg,
                    "One standard deviation of the direction, degrees; None with the paper's solver.")
      .def_readonly("irradiance_uncertainty", &MainLight::irradiance_uncertainty,
                    "One standard deviation of the irradiance, relative; None with the paper's solver.")
      .def("__repr__", &text_of);

  using ResultPtr = std::shared_ptr<LightResult>;
  py::class_<LightResult, ResultPtr> result(module, "LightResult", "One estimated light, in every form people use.");
  call_public(result);
  result
      .def_property_readonly(
          "environment", [](const ResultPtr& l) { return std::shared_ptr<EnvMap>(l, &l->environment); },
          "The light as an EnvMap.")
      .def_property_readonly(
          "confidence", [](const ResultPtr& l) { return std::shared_ptr<EnvMap>(l, &l->confidence); },
          "EnvMap of how well each direction was observed, 0 to 1, the same in all three channels.")
      .def_property_readonly(
          "sh", [](const ResultPtr& l) { return table(l->sh); },
          R"(float64 (9, 3): real spherical harmonics of the radiance, orthonormal, without the Condon-Shortley sign.

Order (0,0), (1,-1), (1,0), (1,1), (2,-2) .. (2,2); (1,-1), (1,0), (1,1) go with y, z, x. A copy.)")
      .def_property_readonly(
          "sh4", [](const ResultPtr& l) { return table(l->sh4); }, "float64 (25, 3): the same up to order 4. A copy.")
      .def_property_readonly(
          "light_to_ambient_ratio", [](const ResultPtr& l) { return lighting::light_to_ambient_ratio(l->lights); },
          "Energy of the main lights over that of all the rest; 0 without main lights.")
      .def_property_readonly(
          "highlight_residual", [](const ResultPtr& l) { return l->light.highlight_residual; },
          R"(What the light leaves unexplained of the face's highlights: relative root mean square, 0 = nothing.

None where no highlights were used.)")
      .def_property_readonly(
          "shading_residual", [](const ResultPtr& l) { return l->light.shading_residual; },
          "The same of the shading; None where no shading was used.")
      .def_property_readonly(
          "lights", [](const ResultPtr& l) { return l->lights; }, "list of Light, by falling strength.")
      .def("__repr__", [](const ResultPtr& l) {
        return "<faceprobe.LightResult with " + std::to_string(l->lights.size()) + " main lights>";
      });
}

}  // namespace faceprobe::python

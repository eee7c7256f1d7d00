// Face: where it is, its light, and its layers as views.

#include "arrays.h"
#include "bind.h"
#include "faceprobe/pipeline/estimate.h"

#include <pybind11/stl.h>

#include <cstdio>
#include <memory>
#include <optional>

namespace faceprobe::python {

namespace {

using pipeline::FaceEstimate;
using FacePtr = std::shared_ptr<FaceEstimate>;

py::tuple box_of(const FaceEstimate& face) {
  const face::Box& box = face.face.box;
  return py::make_tuple(box.x, box.y, box.width, box.height);
}

py::object shading_gain_of(const FaceEstimate& face) {
  if (!face.same_person) return py::none();
  return table(face.same_person->shading_gain);
}

py::object skin_albedo_of(const FaceEstimate& face) {
  const std::optional<Eigen::Vector3f> albedo = pipeline::mean_skin_albedo(face);
  if (!albedo) return py::none();
  return table(*albedo);
}

std::string text_of(const FaceEstimate& face) {
  const face::Box& box = face.face.box;
  char text[128];
  std::snprintf(text, sizeof text, "<faceprobe.Face at (%.0f, %.0f), %.0f x %.0f px, %zu main lights>",
                static_cast<double>(box.x), static_cast<double>(box.y), static_cast<double>(box.width),
                static_cast<double>(box.height), face.lights.size());
  return text;
}

}  // namespace

void bind_face(py::module_& module) {
  py::class_<FaceEstimate, pipeline::LightResult, FacePtr> type(module, "Face",
                                                                R"(A face of a photo, and the light on it.

Layers are pictures of a crop of the photo, h x w pixels: read-only views without a copy, valid however long they are kept.
Colours are linear Rec.709, 1 = the photo's white.)");
  call_public(type);
  type.def_property_readonly("box", &box_of, "(x, y, width, height) in pixels of the photo.")
      .def_property_readonly(
          "score", [](const FaceEstimate& f) { return f.face.score; }, "How sure it is that this is a face, 0 to 1.")
      .def_property_readonly(
          "landmarks", [](const FaceEstimate& f) { return table(f.face.landmarks_px); },
          "float32 (468, 3): x, y in pixels of the photo, z in pixels from the face's mean depth, smaller is nearer. A "
          "copy.")
      .def_property_readonly(
          "camera_from_face", [](const FaceEstimate& f) { return table(f.face.camera_from_face.matrix()); },
          "float64 (4, 4): takes points of the mean face, metres, into the camera frame. A copy.")
      .def_property_readonly(
          "position_m", [](const FaceEstimate& f) { return table(f.face.position_m()); },
          "float64 (3,): between the ears, metres, camera frame; z < 0. A copy.")
      .def_property_readonly(
          "light_colour", [](const FaceEstimate& f) { return table(f.light_colour); },
          "float32 (3,): mean light by what is known of skin, green = 1. A copy.")
      .def_property_readonly(
          "light_colour_uncertainty_deg", [](const FaceEstimate& f) { return f.light_colour_uncertainty_deg; },
          R"(One standard deviation of light_colour: angle to the true colour of the light, degrees.

None where the network split albedo and shading (shading="net"), and of a grey photo.)")
      .def_property_readonly(
          "skin_albedo_mean", &skin_albedo_of,
          R"(float32 (3,): albedo of the skin, linear, mean by the light that falls on it. A copy; None without any.

Its level is assumed: a photo does not tell a dark skin from a short exposure, so this does not say how light a skin is.)")
      .def_property_readonly(
          "shading_gain", &shading_gain_of,
          R"(float32 (3,): what the light of this photo was multiplied by so that its skin is the person's. A copy.

None without Estimator.same_person.)")
      .def_property_readonly(
          "crop",
          [](const FaceEstimate& f) {
            const face::Crop& crop = f.geometry.crop;
            return py::make_tuple(crop.x_px, crop.y_px, crop.scale);
          },
          "(x, y, scale): the crop's top left corner in the photo, and its pixels per pixel of the photo.")
      .def_property_readonly(
          "picture", [](const FacePtr& f) { return view(f, f->picture); }, "float32 (h, w, 3): the photo in the crop.")
      .def_property_readonly(
          "highlight", [](const FacePtr& f) { return view(f, f->layers.highlight); },
          "float32 (h, w, 3): what the skin mirrors; 0 off the skin.")
      .def_property_readonly(
          "diffuse", [](const FacePtr& f) { return view(f, f->layers.diffuse); },
          "float32 (h, w, 3): picture - highlight.")
      .def_property_readonly(
          "albedo", [](const FacePtr& f) { return view(f, f->albedo); }, "float32 (h, w, 3): colour of the skin.")
      .def_property_readonly(
          "shading", [](const FacePtr& f) { return view(f, f->shading); },
          "float32 (h, w, 3): diffuse / albedo, which is irradiance / pi; 0 off the skin.")
      .def_property_readonly(
          "normals", [](const FacePtr& f) { return view(f, f->geometry.normal_cam); },
          "float32 (h, w, 3): unit vectors, camera frame; 0 off the face.")
      .def_property_readonly(
          "regions", [](const FacePtr& f) { return view(f, f->geometry.region); },
          "uint8 (h, w): what each pixel is; 0 is background, 1 to 10 are regions of skin.")
      .def("__repr__", &text_of);
}

}  // namespace faceprobe::python

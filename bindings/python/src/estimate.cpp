// estimate, separate, Estimator, Estimate.

#include "estimate.h"

#include "arrays.h"
#include "bind.h"
#include "faceprobe/core/error.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/report.h"
#include "options.h"

namespace faceprobe::python {

namespace {

using pipeline::EstimateOptions;
using LayersPtr = std::shared_ptr<highlight::Layers>;

constexpr const char* kKeywords = R"(
separator: "net" (trained), or "tan", "yang", "shen" (classical).
weights: path of the network's weights in place of those that come with the program.
geometry: where normals come from: "net" or "mesh".
shading: what splits the diffuse layer: "net" or "regions" (one albedo a region).
prior: what light the transport solver starts from: "net" or "smooth".
solver: "transport", or "paper" (the published scheme).
compact_light: whether the transport solver tries the dominant light as a small disc and keeps it where the pixels ask for one.
iterations: of Richardson-Lucy; else few from the light that the prior expects, more without one (options of the report).
size: width of the environment maps, a multiple of 4, or "WIDTHxHEIGHT" with WIDTH = 2 HEIGHT.
layer_px: long side of the layers; they are never enlarged.
focal_px: focal length in pixels of the photo; else from EXIF, else a 50 mm lens.
landmarks: float32 (5, 2) or (68, 2), or as many pairs of numbers, in pixels, of one face, instead of detection.
threads: 0 = all.
deterministic: bitwise the same result for any number of threads.
device: "auto" or "cpu"; "cuda[:N]" raises DeviceError in this version.

Raises NoFaceError, InputError, UsageError, ModelError, DeviceError.)";

std::shared_ptr<TurnTaker> make(EstimateOptions options) {
  const py::gil_scoped_release release;
  return std::make_shared<TurnTaker>(std::move(options));
}

EstimatedPtr estimate_with(const TurnTaker& estimator, const py::object& photo) {
  PhotoSource source(photo);
  const py::gil_scoped_release release;
  std::string name = source.name();
  return estimator.estimate(std::move(source).load(), std::move(name));
}

LayersPtr separate_with(const TurnTaker& estimator, const py::object& photo) {
  PhotoSource source(photo);
  const py::gil_scoped_release release;
  return std::make_shared<highlight::Layers>(estimator.separate(std::move(source).load()));
}

std::shared_ptr<pipeline::LightResult> joint_with(const TurnTaker& estimator,
                                                  const std::vector<EstimatedPtr>& estimates) {
  const py::gil_scoped_release release;
  std::vector<pipeline::FaceEvidence> faces;
  for (const EstimatedPtr& one : estimates) {
    if (!one) throw Error(ExitCode::kUsage, "One of the estimates is None.");
    for (const pipeline::FaceEstimate& face : one->estimate.faces) faces.push_back(pipeline::evidence_of(face));
  }
  if (faces.empty()) throw Error(ExitCode::kUsage, "There is no estimate to join; give at least one.");
  return std::make_shared<pipeline::LightResult>(estimator.joint(faces));
}

std::vector<EstimatedPtr> same_person_with(const TurnTaker& estimator, const std::vector<EstimatedPtr>& estimates) {
  const py::gil_scoped_release release;
  if (estimates.size() < 2) {
    throw Error(ExitCode::kUsage,
                "Photos of one person are two at least, found " + std::to_string(estimates.size()) + ".");
  }
  std::vector<pipeline::Estimate> photos;
  for (const EstimatedPtr& one : estimates) {
    if (!one) throw Error(ExitCode::kUsage, "One of the estimates is None.");
    photos.push_back(one->estimate);  // the old ones keep theirs: arrays look into them
  }
  estimator.same_person(photos);
  std::vector<EstimatedPtr> shared;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const Estimated& old = *estimates[i];
    shared.push_back(std::make_shared<Estimated>(Estimated{old.photo, std::move(photos[i]), old.options, old.source}));
  }
  return shared;
}

EstimatedPtr estimate(const py::object& photo, EstimateOptions options) {
  PhotoSource source(photo);  // before the models: a typing error should not cost their loading
  const py::gil_scoped_release release;
  std::string name = source.name();
  io::Photo loaded = std::move(source).load();
  return TurnTaker(std::move(options)).estimate(std::move(loaded), std::move(name));
}

LayersPtr separate(const py::object& photo, EstimateOptions options) {
  PhotoSource source(photo);
  const py::gil_scoped_release release;
  const io::Photo loaded = std::move(source).load();
  return std::make_shared<highlight::Layers>(TurnTaker(std::move(options)).separate(loaded));
}

std::shared_ptr<pipeline::FaceEstimate> face_of(const EstimatedPtr& estimated, std::size_t i) {
  return {estimated, &estimated->estimate.faces[i]};
}

std::vector<std::shared_ptr<pipeline::FaceEstimate>> faces_of(const EstimatedPtr& estimated) {
  std::vector<std::shared_ptr<pipeline::FaceEstimate>> faces;
  for (std::size_t i = 0; i < estimated->estimate.faces.size(); ++i) faces.push_back(face_of(estimated, i));
  return faces;
}

std::shared_ptr<pipeline::LightResult> joint_of(const EstimatedPtr& estimated) {
  std::optional<pipeline::LightResult>& joint = estimated->estimate.joint;
  return joint ? std::shared_ptr<pipeline::LightResult>(estimated, &*joint) : nullptr;
}

std::vector<std::pair<std::string, double>> timings_of(const Estimated& estimated) {
  std::vector<std::pair<std::string, double>> timings;
  for (const pipeline::StageTime& stage : estimated.estimate.timings) timings.emplace_back(stage.stage, stage.seconds);
  return timings;
}

std::vector<std::filesystem::path> save(const Estimated& estimated, const std::filesystem::path& folder,
                                        const std::string& orientation, bool layers, bool overview) {
  const pipeline::OutputOptions output{pipeline::orientation_from_name(orientation, "orientation"), layers, overview};
  const py::gil_scoped_release release;
  return pipeline::write_outputs(folder, estimated.estimate, estimated.photo, estimated.options, estimated.source,
                                 output);
}

void bind_result(py::module_& module) {
  py::class_<Estimated, EstimatedPtr> type(module, "Estimate", "The light on the faces of a photo.");
  call_public(type);
  type.def_property_readonly("faces", &faces_of, "list of Face, left to right; never empty.")
      .def_property_readonly(
          "largest", [](const EstimatedPtr& e) { return face_of(e, e->estimate.largest); },
          "The Face with the largest box.")
      .def_property_readonly("joint", &joint_of,
                             "LightResult: one distant light for all faces; None where there is one face only.")
      .def_property_readonly(
          "width", [](const Estimated& e) { return e.estimate.photo_width; }, "Of the photo, pixels.")
      .def_property_readonly(
          "height", [](const Estimated& e) { return e.estimate.photo_height; }, "Of the photo, pixels.")
      .def_property_readonly(
          "focal_px", [](const Estimated& e) { return e.estimate.camera.focal_px; },
          "Focal length in pixels of the photo.")
      .def_property_readonly(
          "warnings", [](const Estimated& e) { return sentences(e.estimate.warnings); }, "list of sentences.")
      .def_property_readonly("timings", &timings_of, "list of (stage, seconds), in order.")
      .def(
          "to_json", [](const Estimated& e) { return pipeline::report_json(e.estimate, e.photo, e.options, e.source); },
          "What `faceprobe estimate --json` prints: schema faceprobe-report/1.")
      .def("save", &save, py::arg("folder"), py::kw_only(), py::arg("orientation") = "openexr",
           py::arg("layers") = true, py::arg("overview") = true,
           R"(Writes the folder that `faceprobe estimate` leaves; returns the files as a list of pathlib.Path.

orientation: of the maps, as in EnvMap.save. layers, overview: whether these are written. Raises OutputError.)")
      .def("__repr__", [](const Estimated& e) {
        return "<faceprobe.Estimate of " + std::to_string(e.estimate.faces.size()) + " faces in " +
               std::to_string(e.estimate.photo_width) + " x " + std::to_string(e.estimate.photo_height) + " px>";
      });
}

void bind_layers(py::module_& module) {
  py::class_<highlight::Layers, LayersPtr> type(module, "Layers", "A photo as highlight + diffuse.");
  call_public(type);
  type.def_property_readonly(
          "highlight", [](const LayersPtr& layers) { return view(layers, layers->highlight); },
          "float32 (H, W, 3), linear: what the skin mirrors; 0 outside the faces' skin. A read-only view.")
      .def_property_readonly(
          "diffuse", [](const LayersPtr& layers) { return view(layers, layers->diffuse); },
          "float32 (H, W, 3), linear: the photo - highlight. A read-only view.");
}

}  // namespace

void check_same_size(const io::Photo& photo, const Estimated& estimated) {
  const int width = estimated.estimate.photo_width;
  const int height = estimated.estimate.photo_height;
  if (photo.linear.width() == width && photo.linear.height() == height) return;
  throw Error(ExitCode::kUsage, "The estimate is of a photo of " + std::to_string(width) + " x " +
                                    std::to_string(height) + " pixels, but the picture has " +
                                    std::to_string(photo.linear.width()) + " x " +
                                    std::to_string(photo.linear.height()) + ".");
}

void bind_estimate(py::module_& module) {
  bind_result(module);
  bind_layers(module);
  const std::string keywords = kKeywords;
  const std::string photo = R"(
photo: a path; or uint8 (H, W, 3), sRGB; or float32 (H, W, 3), linear Rec.709, 1 = white, not negative. Arrays must be
    C-contiguous. They are copied and never converted.)";
  const std::string of_estimator =
      "Estimates light, with the models loaded once.\n\nThreads that share one take turns; for two photos at a time "
      "make two.\n";
  const std::string of_estimate = "The light on the faces of a photo, as an Estimate.\n" + photo;
  const std::string of_separate = "Highlight and diffuse layer of a photo at its own size, as Layers.\n" + photo +
                                  "\nKeywords that do not matter here are taken too.";
  py::class_<TurnTaker, std::shared_ptr<TurnTaker>> estimator(module, "Estimator", of_estimator.c_str());
  call_public(estimator);
  with_option_arguments([&](const auto&... keyword) {
    estimator.def(py::init(taking_options<>(&make)), keyword..., keywords.c_str());
    module.def("estimate", taking_options<py::object>(&estimate), py::arg("photo"), keyword...,
               (of_estimate + keywords).c_str());
    module.def("separate", taking_options<py::object>(&separate), py::arg("photo"), keyword...,
               (of_separate + keywords).c_str());
  });
  estimator.def("estimate", &estimate_with, py::arg("photo"), of_estimate.c_str())
      .def("separate", &separate_with, py::arg("photo"),
           ("Highlight and diffuse layer of a photo at its own size, as Layers.\n" + photo).c_str())
      .def("joint", &joint_with, py::arg("estimates"),
           R"(One distant LightResult for the faces of several photos, as `faceprobe estimate --same-light`.

estimates: of photos that one camera took from one place in the same light, such as a burst. Each face is first scaled to
    the mean energy of the single estimates, because photos tell neither albedos nor exposures. Raises UsageError for none.)")
      .def("same_person", &same_person_with, py::arg("estimates"),
           R"(New Estimates of photos of one person, each in a light of its own, as `faceprobe estimate --same-person`.

estimates: two at least, of this Estimator. The largest face of each photo takes the person's albedo, level and tint region by
    region, and one gain of highlights; its light is found again. Face.shading_gain says what changed. Raises UsageError.)");
}

}  // namespace faceprobe::python

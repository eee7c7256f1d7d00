// insert, Insertion.

#include "faceprobe/insert/insert.h"

#include "arrays.h"
#include "bind.h"
#include "estimate.h"
#include "faceprobe/assets/named_model.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/insertion.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "options.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::python {

namespace {

// The insertion with what it was made of, so that it can be saved.
struct Inserted {
  insert::Insertion done;
  insert::Scene scene;
  std::string photo, object;
  std::vector<std::string> warnings;
};
using InsertedPtr = std::shared_ptr<Inserted>;

using MatteSource = std::variant<py::array, std::filesystem::path>;

Image matte_from_array(const py::array& array) {
  Image matte = image_from<float>(array, "matte", 1);
  if (!std::ranges::all_of(matte.values(), [](float share) { return share >= 0 && share <= 1; }))
    throw py::value_error("matte holds values that are not from 0 to 1.");
  return matte;
}

void check(const std::string& fault) {
  if (!fault.empty()) throw Error(ExitCode::kUsage, fault);
}

using ColourSource = std::variant<std::string, std::array<float, 3>>;

render::MaterialChange change_of(const std::optional<std::string>& kind, const std::optional<ColourSource>& colour,
                                 std::optional<float> roughness, std::optional<float> ior) {
  render::MaterialChange change{.roughness = roughness, .ior = ior};
  if (kind) change.kind = render::material_kind_from_name(*kind);
  if (!colour) return change;
  if (const auto* rgb = std::get_if<std::array<float, 3>>(&*colour)) {
    change.colour = Eigen::Vector3f((*rgb)[0], (*rgb)[1], (*rgb)[2]);
  } else {
    change.colour = render::colour_from(std::get<std::string>(*colour));
  }
  return change;
}

InsertedPtr insert_into(const py::object& photo, const std::filesystem::path& object,
                        const std::optional<std::string>& material, const std::optional<ColourSource>& colour,
                        const std::optional<std::string>& kind, std::optional<float> roughness,
                        std::optional<float> ior, const std::optional<std::array<double, 2>>& at,
                        std::optional<float> beside, std::optional<float> distance, std::optional<float> height,
                        double turn, std::optional<double> horizon, bool ground, const std::optional<MatteSource>& matte,
                        int samples, double noise, std::uint64_t seed, int threads, EstimatedPtr estimated) {
  check_threads(threads);
  PhotoSource source(photo);
  pipeline::InsertionOptions where{.beside_m = beside,
                                   .depth_m = distance,
                                   .height_m = height,
                                   .turn_deg = static_cast<float>(turn),
                                   .horizon_px = horizon,
                                   .ground = ground};
  if (at) where.at_px = Eigen::Vector2d((*at)[0], (*at)[1]);
  insert::Options how;
  how.render.samples = samples;
  how.render.noise = static_cast<float>(noise);
  how.render.seed = seed;
  how.render.threads = threads;
  const render::MaterialChange change = change_of(kind, colour, roughness, ior);
  check(where.validate());
  check(how.validate());
  std::optional<std::filesystem::path> matte_file;
  if (matte && std::holds_alternative<py::array>(*matte)) where.matte = matte_from_array(std::get<py::array>(*matte));
  if (matte && std::holds_alternative<std::filesystem::path>(*matte))
    matte_file = std::get<std::filesystem::path>(*matte);

  const py::gil_scoped_release release;
  auto out = std::make_shared<Inserted>();
  out->photo = source.name();
  out->object = object.string();
  assets::LoadedModel model = assets::model_named(object, material.value_or(""), change);
  out->warnings = std::move(model.warnings);
  if (matte_file) where.matte = pipeline::matte_from(io::load_photo(*matte_file));
  const io::Photo loaded = std::move(source).load();
  if (estimated) {
    check_same_size(loaded, *estimated);
  } else {
    pipeline::EstimateOptions options;
    options.threads = threads;
    estimated = TurnTaker(std::move(options)).estimate(loaded, out->photo);
    const std::vector<std::string>& more = estimated->estimate.warnings;
    out->warnings.insert(out->warnings.end(), more.begin(), more.end());
  }
  out->scene = pipeline::scene_for(loaded, estimated->estimate, std::move(model.model), where);
  out->done = insert::insert_model(loaded.linear, out->scene, how);
  return out;
}

std::vector<std::filesystem::path> save(const Inserted& inserted, const std::filesystem::path& path) {
  const py::gil_scoped_release release;
  if (!io::is_picture_file(path))
    return pipeline::write_insertion(path, inserted.done, inserted.scene, inserted.photo, inserted.object);
  io::write_picture(path, inserted.done.picture);
  return {path};
}

void bind_result(py::module_& module) {
  py::class_<Inserted, InsertedPtr> type(module, "Insertion", R"(A photo with an object in it.

The layers cover the box alone that was drawn, h x w pixels; with x, y, w, h = box they belong at picture[y:y+h, x:x+w].
Arrays are read-only views without a copy, valid however long they are kept.)");
  call_public(type);
  type.def_property_readonly(
          "picture", [](const InsertedPtr& i) { return view(i, i->done.picture); },
          "float32 (H, W, 3): the photo with the object, linear Rec.709.")
      .def_property_readonly(
          "box",
          [](const Inserted& i) {
            return py::make_tuple(i.done.box.left, i.done.box.top, i.done.box.width(), i.done.box.height());
          },
          "(x, y, width, height) in pixels: what was drawn; outside, the picture is the photo.")
      .def_property_readonly(
          "object", [](const InsertedPtr& i) { return view(i, i->done.layers.object); },
          "float32 (h, w, 4): the object alone, linear, premultiplied by its alpha.")
      .def_property_readonly(
          "shadow", [](const InsertedPtr& i) { return view(i, i->done.layers.shadow); },
          "float32 (h, w, 3): factor on the photo; 1 where no shadow falls.")
      .def_property_readonly(
          "depth", [](const InsertedPtr& i) { return view(i, i->done.layers.depth); },
          "float32 (h, w): metres along -z; 0 off the object.")
      .def_property_readonly(
          "normal", [](const InsertedPtr& i) { return view(i, i->done.layers.normal); },
          "float32 (h, w, 3): camera frame; 0 off the object.")
      .def_property_readonly(
          "warnings", [](const Inserted& i) { return sentences(i.warnings); }, "list of sentences.")
      .def(
          "to_json", [](const Inserted& i) { return pipeline::insertion_json(i.done, i.scene, i.photo, i.object); },
          "What `faceprobe insert --json` prints: schema faceprobe-insert/1.")
      .def("save", &save, py::arg("path"),
           R"(NAME.png, NAME.exr or NAME.hdr: the picture alone; else the folder that `faceprobe insert` leaves.

Returns the files as a list of pathlib.Path. Raises OutputError.)");
}

}  // namespace

void bind_insert(py::module_& module) {
  bind_result(module);
  const insert::Options usual;
  const double usual_noise = std::round(1e6 * static_cast<double>(usual.render.noise)) / 1e6;  // .03, and not .02999...
  module.def("insert", &insert_into, py::arg("photo"), py::arg("object") = "pot", py::kw_only(),
             py::arg("material") = py::none(), py::arg("colour") = py::none(), py::arg("kind") = py::none(),
             py::arg("roughness") = py::none(), py::arg("ior") = py::none(), py::arg("at") = py::none(),
             py::arg("beside") = py::none(), py::arg("distance") = py::none(), py::arg("height") = py::none(),
             py::arg("turn") = 0.0, py::arg("horizon") = py::none(), py::arg("ground") = true,
             py::arg("matte") = py::none(), py::arg("samples") = usual.render.samples, py::arg("noise") = usual_noise,
             py::arg("seed") = 1, py::arg("threads") = 0, py::arg("estimate") = py::none(),
             R"(Puts an object into a photo, in the light of its faces; returns an Insertion.

photo: as for estimate().
object: "sphere", "cube", "pot", "robot", "spheres", or the path of an OBJ, PLY, STL, glTF or GLB file.
material: in place of the object's own: "diffuse", "plastic", "silver", "gold", "mirror", "glass", "clay", "red".
colour, kind, roughness, ior: of that material or the object's own, changed: (r, g, b) of linear light or "#rrggbb"; "diffuse", "metal",
"plastic", "glass"; 0 to 1, of metal and plastic; the index of refraction, 1 to 3, of plastic and glass.
at: (x, y), pixel of the photo where its foot stands; else the lower corner with more room.
beside: in place of at, metres to the right of the largest face, below 0 to its left; as far away as the face and low in the picture.
distance: metres from the camera; else the largest face's with beside, three quarters of it without.
height: metres; else its longer side takes 35 % of the picture's shorter one.
turn: degrees about its own axis, its front to the right.
horizon: height of the horizon in the photo, pixels from the top; else from the heads.
ground: False, and it floats: nothing takes its shadow.
matte: float32 (H, W) from 0 to 1, or the path of a picture of the photo's size: 1 or white where a person stands before far things.
samples: most rays per pixel. noise: stop where the picture is this quiet; 0: never before `samples`.
seed: of the rays. threads: 0 = all.
estimate: the photo's Estimate; else one is made with default options. It may be that of the photo before another object was put in.

Raises NoFaceError, InputError, UsageError, ModelError.)");
}

}  // namespace faceprobe::python

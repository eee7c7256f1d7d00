#include "faceprobe/pipeline/insertion_files.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json array_of(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// A layer of the box in a picture of the photo's size.
Image whole(const Image& layer, const insert::Insertion& done, float outside) {
  Image out(done.picture.width(), done.picture.height(), layer.channels(), outside);
  for (int y = 0; y < layer.height(); ++y)
    std::copy_n(layer.pixel(0, y), layer.row(y).size(), out.pixel(done.box.left, done.box.top + y));
  return out;
}

// sRGB with straight alpha, as picture editors take it.
ByteImage straight(const Image& premultiplied) {
  ByteImage out(premultiplied.width(), premultiplied.height(), 4);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const float alpha = std::clamp(premultiplied(x, y, 3), 0.0F, 1.0F);
      if (alpha <= 0) continue;
      for (int c = 0; c < 3; ++c) {
        const float encoded = srgb_from_linear(std::clamp(premultiplied(x, y, c) / alpha, 0.0F, 1.0F));
        out(x, y, c) = static_cast<std::uint8_t>(std::lround(255 * encoded));
      }
      out(x, y, 3) = static_cast<std::uint8_t>(std::lround(255 * alpha));
    }
  }
  return out;
}

}  // namespace

std::string insertion_json(const insert::Insertion& done, const insert::Scene& scene, const std::string& photo,
                           const std::string& object) {
  const Eigen::AlignedBox3f box = scene.model.box();
  Json json;
  json["schema"] = "faceprobe-insert/1";
  json["program"] = {{"name", "faceprobe"}, {"version", kVersion}};
  json["photo"] = photo;
  json["object"] = object;
  json["frame"] = "camera: +x right in the photo, +y up, +z towards the viewer; metres";
  json["object_box_m"] = {{"min", array_of(box.min())}, {"max", array_of(box.max())}};
  json["up"] = array_of(scene.up);
  json["triangles"] = scene.model.triangle_count();
  json["ground"] = scene.ground ? Json{{"albedo", array_of(done.ground_albedo)}} : Json(nullptr);
  json["lamps"] = Json::array();
  for (const render::BallLamp& lamp : scene.lamps)
    json["lamps"].push_back({{"position_m", array_of(lamp.position_m)},
                             {"radius_m", lamp.radius_m},
                             {"intensity", array_of(lamp.intensity)}});
  json["box_px"] = {
      {"left", done.box.left}, {"top", done.box.top}, {"width", done.box.width()}, {"height", done.box.height()}};
  json["blur_px"] = done.blur_px;
  json["grain_sigma"] = done.grain.sigma;
  json["complete"] = !done.stopped;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::filesystem::path> write_insertion(const std::filesystem::path& folder, const insert::Insertion& done,
                                                   const insert::Scene& scene, const std::string& photo,
                                                   const std::string& object) {
  io::create_folder(folder);
  std::vector<std::filesystem::path> files;
  const auto write = [&](const char* name, const auto& picture) {
    files.push_back(folder / name);
    io::write_picture(files.back(), picture);
  };
  const Image model = whole(done.layers.object, done, 0);
  write("composite.png", done.picture);
  write("composite.exr", done.picture);
  write("object.png", straight(model));
  write("object.exr", model);
  write("shadow.exr", whole(done.layers.shadow, done, 1));
  write("depth.exr", whole(done.layers.depth, done, 0));
  write("normal.exr", whole(done.layers.normal, done, 0));
  files.push_back(folder / "insert.json");
  io::write_file_atomically(files.back(), insertion_json(done, scene, photo, object));
  return files;
}

}  // namespace faceprobe::pipeline

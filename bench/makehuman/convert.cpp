#include "makehuman/convert.h"

#include "cycles/passes.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/region.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/synth/photo_layers.h"
#include "synth/generate/light_sample_draw.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace faceprobe::bench {
namespace {

Eigen::Map<const Eigen::Vector3f> colour(const Image& image, std::size_t pixel) {
  return Eigen::Map<const Eigen::Vector3f>(image.data() + 3 * pixel);
}

struct Layers {
  Image highlight, diffuse, albedo;
  Image normal_world;
  ByteImage skin;  // 1 where a pixel is skin through and through
};

Layers read_layers(const std::filesystem::path& path) {
  const PassFile file(path);
  Layers layers{file.pass("GlossDir", "RGB"),
                file.pass("Combined", "RGB"),
                file.pass("DiffCol", "RGB"),
                file.pass("Normal", "XYZ"),
                {}};
  const Image indirect = file.pass("GlossInd", "RGB");
  const Image reflectance = file.pass("GlossCol", "RGB");
  const Image index = file.pass("IndexMA", "X");
  layers.skin = ByteImage(index.width(), index.height(), 1);
  for (std::size_t i = 0; i < index.pixel_count(); ++i) layers.skin.data()[i] = index.data()[i] > 0.99F ? 1 : 0;
  for (std::size_t i = 0; i < layers.highlight.values().size(); ++i) {
    float& highlight = layers.highlight.data()[i];
    float& rest = layers.diffuse.data()[i];
    float& albedo = layers.albedo.data()[i];
    const float mirrored = (highlight + indirect.data()[i]) * reflectance.data()[i];
    // Cycles divides by what a pixel's samples reflect; where some have nothing to, its passes are no numbers. Such pixels do not count.
    if (!std::isfinite(mirrored + rest + albedo)) {
      layers.skin.data()[i / 3] = 0;
      highlight = albedo = 0;
      if (!std::isfinite(rest)) rest = 0;
      continue;
    }
    highlight = std::clamp(mirrored, 0.0F, std::max(0.0F, rest));
    rest -= highlight;
  }
  return layers;
}

// As the generator of training faces exposes: by the mean of the skin, its tone and the light's colour.
Eigen::Vector3f gain_of(const Layers& layers, const synth::SampleDraw& draw) {
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();
  Eigen::Vector3f light = Eigen::Vector3f::Zero();
  Eigen::Vector3f tone = Eigen::Vector3f::Zero();
  float count = 0;
  for (std::size_t i = 0; i < layers.skin.pixel_count(); ++i) {
    if (layers.skin.data()[i] == 0) continue;
    const Eigen::Vector3f diffuse = colour(layers.diffuse, i);
    const Eigen::Vector3f albedo = colour(layers.albedo, i);
    radiance += diffuse + colour(layers.highlight, i);
    light += diffuse.cwiseQuotient(albedo.cwiseMax(0.01F));
    tone += albedo;
    count += 1;
  }
  if (count == 0) return Eigen::Vector3f::Ones();
  return synth::exposure_gain(draw, radiance / count, light / count, tone / count);
}

void scale(const Eigen::Vector3f& gain, Image& image) {
  for (std::size_t i = 0; i < image.values().size(); ++i) image.data()[i] *= gain(static_cast<Eigen::Index>(i % 3));
}

struct TrueCamera {
  float focal_px = 0;
  Eigen::Matrix3f camera_from_world;
};

TrueCamera read_camera(std::filesystem::path path) {
  path.replace_extension(".json");
  std::ifstream file(path);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) throw Error(ExitCode::kModel, "Blender left no camera " + path.string() + ".");
  TrueCamera camera;
  camera.focal_px = json.at("focal_px").get<float>();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      camera.camera_from_world(column, row) =
          json.at("world_from_camera").at(static_cast<std::size_t>(row)).at(static_cast<std::size_t>(column)).get<float>();
  }
  return camera;
}

// Where Cycles says a pixel is skin all through, and its pass is a direction.
Image normals(const Layers& layers, const TrueCamera& camera) {
  Image normal(layers.skin.width(), layers.skin.height(), 3);
  for (std::size_t i = 0; i < layers.skin.pixel_count(); ++i) {
    const Eigen::Vector3f world = colour(layers.normal_world, i);
    if (layers.skin.data()[i] == 0 || !world.allFinite() || world.norm() < 0.5F) continue;
    Eigen::Map<Eigen::Vector3f>(normal.data() + 3 * i) = camera.camera_from_world * world.normalized();
  }
  return normal;
}

Image quotient(const Image& diffuse, const Image& albedo) {
  constexpr float kLeast = 0.01F;
  Image shading(diffuse.width(), diffuse.height(), 3);
  for (std::size_t i = 0; i < shading.values().size(); ++i) {
    if (albedo.data()[i] > kLeast) shading.data()[i] = diffuse.data()[i] / albedo.data()[i];
  }
  return shading;
}

// The mesh knows eyes, lips and brows where Cycles has skin and little else.
Region region_of(bool skin, bool inside, std::uint8_t mesh) {
  if (!skin) return Region::kNone;
  if (!inside) return Region::kOther;
  return mesh == 0 || mesh >= static_cast<std::uint8_t>(Region::kOther) ? Region::kCheeks : static_cast<Region>(mesh);
}

}  // namespace

std::optional<synth::ViewSamples> convert(const std::filesystem::path& picture, const face::FaceFinder& finder,
                                          const face::CanonicalMesh& mesh, std::uint64_t seed, int number) {
  Layers layers = read_layers(picture);
  const int width = layers.skin.width();
  const int height = layers.skin.height();
  Random random({seed, 0x3A4E, static_cast<std::uint64_t>(number)});
  synth::SampleDraw draw;
  synth::draw_camera(random, width, draw);
  const Eigen::Vector3f gain = gain_of(layers, draw);
  scale(gain, layers.highlight);
  scale(gain, layers.diffuse);
  Image radiance = layers.diffuse;
  for (std::size_t i = 0; i < radiance.values().size(); ++i) radiance.data()[i] += layers.highlight.data()[i];
  const synth::SensorPicture photo = synth::take_picture(radiance, draw.sensor, random);

  const TrueCamera true_camera = read_camera(picture);
  const face::Camera camera{
      .focal_px = static_cast<double>(true_camera.focal_px), .centre_x_px = width / 2.0, .centre_y_px = height / 2.0};
  const std::vector<face::Face> faces = finder.find(decode_srgb(photo.photo), camera);
  if (faces.empty()) return std::nullopt;
  const auto largest = std::max_element(faces.begin(), faces.end(),
                                        [](const auto& a, const auto& b) { return a.box.width < b.box.width; });
  synth::ViewSamples out;
  synth::ViewLayers& view = out.view;
  view.normal = normals(layers, true_camera);
  view.depth_m = Image(width, height, 1);
  view.region = ByteImage(width, height, 1);
  view.owner = layers.skin;
  view.focal_px = static_cast<float>(camera.focal_px);
  view.centre_px = {static_cast<float>(width) / 2, static_cast<float>(height) / 2};
  view.faces.resize(1);
  view.faces[0].dense_landmarks_px = largest->landmarks_px.leftCols(2);
  view.faces[0].person = number;
  const ByteImage inside = synth::face_mask(view, 1.0F);
  const face::Crop whole{.x_px = 0, .y_px = 0, .scale = 1, .width = width, .height = height};
  const ByteImage mesh_regions = face::rasterize_regions(*largest, camera, mesh, whole);
  for (std::size_t i = 0; i < inside.pixel_count(); ++i)
    view.region.data()[i] =
        static_cast<std::uint8_t>(region_of(layers.skin.data()[i] != 0, inside.data()[i] != 0, mesh_regions.data()[i]));
  synth::Sample& sample = out.samples.emplace_back();
  sample.photo = photo.photo;
  sample.clip = photo.clip;
  sample.highlight = std::move(layers.highlight);
  sample.diffuse = std::move(layers.diffuse);
  sample.albedo = std::move(layers.albedo);
  sample.shading = quotient(sample.diffuse, sample.albedo);
  sample.environment = EnvMap(4, 2);
  sample.settings_json = "{}";
  return out;
}

}  // namespace faceprobe::bench

#include "pipeline/read_layers.h"

#include "faceprobe/lighting/albedo.h"
#include "faceprobe/pipeline/observe.h"
#include "pipeline/apply_surface.h"
#include "pipeline/given_shading.h"
#include "pipeline/stopwatch.h"
#include "pipeline/take_colour_off.h"

#include <algorithm>

namespace faceprobe::pipeline {
namespace {

// Shading = diffuse / albedo on the skin. What the eyes and the mouth reflect is not skin shading.
Image divide(const Image& diffuse, const Image& albedo, const ByteImage& skin) {
  Image shading(diffuse.width(), diffuse.height(), 3);
  for (int y = 0; y < diffuse.height(); ++y) {
    for (int x = 0; x < diffuse.width(); ++x) {
      if (skin(x, y) == 0) continue;
      for (int c = 0; c < 3; ++c) shading(x, y, c) = diffuse(x, y, c) / std::max(1e-3F, albedo(x, y, c));
    }
  }
  return shading;
}

// What turned out to be no skin has no highlights.
void keep_on_skin(const ByteImage& region, highlight::Layers& layers) {
  for (std::size_t i = 0; i < region.pixel_count(); ++i) {
    if (is_skin(static_cast<Region>(region.data()[i]))) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      layers.diffuse.data()[c] += layers.highlight.data()[c];
      layers.highlight.data()[c] = 0;
    }
  }
}

void lap(Stopwatch* watch, const char* stage) {
  if (watch != nullptr) watch->lap(stage);
}

}  // namespace

void read_layers(const FaceReader& reader, const EstimateOptions& options, const face::Camera& camera, bool grey,
                 bool enough, FaceEstimate& face, Stopwatch* watch) {
  Reading reading = reader.read(face.picture, face.clipped, skin_regions(face.geometry.region), face.geometry, enough);
  face.layers = std::move(reading.layers);
  face.sources.classical = reading.classical;
  if (options.normals == NormalSource::kFit) {  // only now: the network has learnt from the mesh's normals
    options.surface_fit(face.face, camera, face.geometry);
    face.sources.normals = NormalSource::kFit;
  } else if (reading.surface && options.normals == NormalSource::kNet) {
    apply_normals(*reading.surface, face.geometry);
    face.sources.normals = NormalSource::kNet;
  }
  if (reading.surface && options.normals != NormalSource::kMesh) {
    apply_regions(*reading.surface, face.geometry);
    keep_on_skin(face.geometry.region, face.layers);
  }
  lap(watch, "highlights and normals");

  const ByteImage skin = skin_regions(face.geometry.region);
  Image shading;
  Image open_shading;
  if (options.shading == ShadingSource::kGiven && enough) {
    shading = given_shading(options.shading_split, face.layers.diffuse, skin, face.clipped, options.threads);
    if (grey) take_colour_off(shading);
  } else if (options.shading == ShadingSource::kNet && reading.surface) {
    shading = std::move(reading.surface->shading);
    open_shading = std::move(reading.surface->open_shading);
  }
  if (!shading.empty()) {
    AlbedoShading split = split_diffuse(shading, face.layers.diffuse, skin);
    face.albedo = std::move(split.albedo);
    face.shading = std::move(split.shading);
    face.light_colour = split.light_colour;
    face.sources.shading = options.shading;
  } else {
    const lighting::AlbedoModel albedo =
        lighting::fit_albedo(face.layers.diffuse, skin, face.clipped, face.geometry.normal_cam, grey);
    face.light_colour = albedo.light_colour;
    face.light_colour_uncertainty_deg = albedo.light_colour_uncertainty_deg;
    face.albedo = lighting::albedo_picture(albedo, skin);
    face.shading = divide(face.layers.diffuse, face.albedo, skin);
  }
  lap(watch, "albedo and shading");

  face.observations = observe(face.geometry, face.layers.highlight, face.shading, face.clipped, options.max_patches,
                              options.threads, open_shading);
  face.observations.grey = grey;
}

}  // namespace faceprobe::pipeline

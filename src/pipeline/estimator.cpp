#include "faceprobe/core/error.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/lighting/albedo.h"
#include "pipeline/apply_surface.h"
#include "pipeline/camera_of.h"
#include "pipeline/estimator_impl.h"
#include "pipeline/light_result.h"
#include "faceprobe/pipeline/observe.h"
#include "pipeline/stopwatch.h"

#include <algorithm>

namespace faceprobe::pipeline {

namespace {

EstimateOptions checked(EstimateOptions options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  options.finder.threads = options.deterministic ? 1 : options.threads;
  options.solve.threads = options.threads;
  return options;
}

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
    if (region.data()[i] >= 1 && region.data()[i] <= kSkinRegionCount) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      layers.diffuse.data()[c] += layers.highlight.data()[c];
      layers.highlight.data()[c] = 0;
    }
  }
}

}  // namespace

Estimator::Impl::Impl(EstimateOptions wanted)
    : options(checked(std::move(wanted))), finder(options.finder),
      mesh(face::load_canonical_mesh(io::data_file("canonical-face-model.obj"))), reader(options) {}

std::vector<face::Face> Estimator::Impl::faces_of(const io::Photo& photo, const face::Camera& camera) const {
  if (options.landmarks_px) return {finder.from_landmarks(photo.linear, camera, *options.landmarks_px)};
  return finder.find(photo.linear, camera);
}

FaceEstimate Estimator::Impl::analyse(const io::Photo& photo, const face::Camera& camera, face::Face found,
                                      Stopwatch& watch) const {
  FaceEstimate out;
  out.face = std::move(found);
  face::GeometryOptions geometry;
  geometry.long_side_px = options.layer_px;
  const face::Crop crop = face::face_crop(out.face, photo.linear.width(), photo.linear.height(), geometry);
  out.geometry = face::rasterize(out.face, camera, mesh, crop);
  out.picture = face::crop_picture(photo.linear, crop);
  out.clipped = face::crop_flags(photo.clipped, crop);
  watch.lap("geometry");

  const bool enough = shown_share(crop, photo.linear.width(), photo.linear.height()) >= options.least_shown;
  Reading reading = reader.read(out.picture, out.clipped, skin_regions(out.geometry.region), out.geometry, enough);
  out.layers = std::move(reading.layers);
  if (reading.surface && options.normals == NormalSource::kNet) {
    apply_normals(*reading.surface, out.geometry);
    keep_on_skin(out.geometry.region, out.layers);
  }
  watch.lap("highlights and normals");

  const ByteImage skin = skin_regions(out.geometry.region);
  if (reading.surface && !reading.surface->shading.empty() && options.shading == ShadingSource::kNet) {
    AlbedoShading split = split_diffuse(*reading.surface, out.layers.diffuse, skin);
    out.albedo = std::move(split.albedo);
    out.shading = std::move(split.shading);
    out.light_colour = split.light_colour;
  } else {
    const lighting::AlbedoModel albedo = lighting::fit_albedo(out.layers.diffuse, skin, out.clipped, photo.grey);
    out.light_colour = albedo.light_colour;
    out.albedo = lighting::albedo_picture(albedo, skin);
    out.shading = divide(out.layers.diffuse, out.albedo, skin);
  }
  watch.lap("albedo and shading");

  out.observations =
      observe(out.geometry, out.layers.highlight, out.shading, out.clipped, options.max_patches, options.threads);
  lighting::Light light = lighting::solve(out.observations, options.solve);
  watch.lap("light");
  static_cast<LightResult&>(out) = light_result(std::move(light), options);
  watch.lap("maps and main lights");
  return out;
}

Estimator::Estimator(EstimateOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Estimator::~Estimator() = default;
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;

const EstimateOptions& Estimator::options() const { return impl_->options; }

std::vector<face::Face> Estimator::find_faces(const io::Photo& photo) const {
  return impl_->faces_of(photo, camera_of(photo, impl_->options).camera);
}

Estimate Estimator::estimate(const io::Photo& photo) const {
  Estimate out;
  Stopwatch watch(out.timings);
  const CameraChoice choice = camera_of(photo, impl_->options);
  out.photo_width = photo.linear.width();
  out.photo_height = photo.linear.height();
  out.camera = choice.camera;
  out.focal_source = choice.source;
  out.warnings = photo.warnings;
  std::vector<face::Face> found = impl_->faces_of(photo, out.camera);
  watch.lap("find faces");
  if (found.empty()) throw no_face(photo, impl_->options);
  for (face::Face& face : found) {
    FaceEstimate estimate = impl_->analyse(photo, out.camera, std::move(face), watch);
    const double shown = shown_share(estimate.geometry.crop, photo.linear.width(), photo.linear.height());
    if (!impl_->options.classical && shown < impl_->options.least_shown) {
      out.warnings.emplace_back(
          "The photo cuts off more than a third of a face; its highlights come from a classical separator, because the "
          "network needs more of a head.");
    }
    if (estimate.observations.count() < 30) {
      out.warnings.push_back("A face " + std::to_string(static_cast<int>(estimate.face.box.width)) +
                             " px wide shows too little skin to read light from and was left out.");
      continue;
    }
    out.faces.push_back(std::move(estimate));
  }
  if (out.faces.empty()) throw Error(ExitCode::kNoFace, "Every face found shows too little skin to read light from.");
  const auto area = [](const FaceEstimate& f) { return f.face.box.width * f.face.box.height; };
  out.largest =
      static_cast<std::size_t>(std::max_element(out.faces.begin(), out.faces.end(),
                                                [&](const auto& a, const auto& b) { return area(a) < area(b); }) -
                               out.faces.begin());
  if (photo.grey && impl_->options.classical) {
    out.warnings.emplace_back(
        impl_->options.solve.solver == lighting::Solver::kPaper
            ? "The photo is grey: the classical separators need colour and the paper's solver reads highlights only, "
              "so the map is black."
            : "The photo is grey: the classical separators need colour, so the light comes from shading alone.");
  }
  if (out.faces.size() > 1) {
    out.joint = light_result(joint_light(out.faces, impl_->options), impl_->options);
    watch.lap("joint light");
  }
  return out;
}

}  // namespace faceprobe::pipeline

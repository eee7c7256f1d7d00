#include "faceprobe/core/error.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/lighting/face_features.h"
#include "pipeline/camera_of.h"
#include "pipeline/estimator_impl.h"
#include "pipeline/expected_light.h"
#include "pipeline/face_warnings.h"
#include "pipeline/light_result.h"
#include "pipeline/read_layers.h"
#include "pipeline/same_person.h"
#include "pipeline/stopwatch.h"
#include "pipeline/take_colour_off.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::pipeline {

namespace {

EstimateOptions checked(EstimateOptions options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  options.finder.threads = options.deterministic ? 1 : options.threads;
  options.solve.threads = options.threads;
  return options;
}

}  // namespace

Estimator::Impl::Impl(EstimateOptions wanted)
    : options(checked(std::move(wanted))), finder(options.finder),
      mesh(face::load_canonical_mesh(io::data_file("canonical-face-model.obj"))), reader(options),
      prior(load_prior(options)) {}

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
  out.picture = face::crop_picture(photo.linear, crop, options.threads);
  if (photo.grey) take_colour_off(out.picture);
  out.clipped = face::crop_flags(photo.clipped, crop);
  watch.lap("geometry");

  out.enough_shown = shown_share(crop, photo.linear.width(), photo.linear.height()) >= options.least_shown;
  read_layers(reader, options, camera, photo.grey, out.enough_shown, out, &watch);
  lighting::Light light = light_of(out.observations, out.enough_shown);
  if (prior && out.enough_shown && lighting::shading_level(out.observations) > 0) out.sources.prior = PriorSource::kNet;
  watch.lap("light");
  static_cast<LightResult&>(out) = solved_light(std::move(light), out.observations, options);
  watch.lap("maps and main lights");
  return out;
}

lighting::Light Estimator::Impl::light_of(const lighting::Observations& observations, bool ask_prior) const {
  return light_of(observations, ask_prior, options.solve);
}

lighting::Light Estimator::Impl::light_of(const lighting::Observations& observations, bool ask_prior,
                                          const lighting::SolveOptions& solve) const {
  const Eigen::MatrixX3f expected =
      prior && ask_prior ? expected_light(*prior, observations, solve.nside) : Eigen::MatrixX3f();
  return lighting::solve(observations, solve, expected);
}

Estimator::Estimator(EstimateOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Estimator::~Estimator() = default;
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;

const EstimateOptions& Estimator::options() const { return impl_->options; }

std::vector<face::Face> Estimator::find_faces(const io::Photo& photo) const {
  return impl_->faces_of(photo, camera_of(photo, impl_->options).camera);
}

lighting::Light Estimator::light_of(const lighting::Observations& observations, bool ask_prior) const {
  return impl_->light_of(observations, ask_prior);
}

LightResult Estimator::joint(const std::vector<FaceEvidence>& faces) const {
  if (faces.empty()) throw std::invalid_argument("A joint light needs a face.");
  const bool all_shown = std::ranges::all_of(faces, [](const FaceEvidence& face) { return face.enough_shown; });
  const lighting::Observations all = joint_observations(faces);
  return solved_light(impl_->light_of(all, all_shown), all, impl_->options);
}

void Estimator::same_person(std::vector<Estimate>& photos) const {
  std::vector<StageTime> times;
  Stopwatch watch(times);
  std::vector<FaceEstimate*> faces;
  for (Estimate& photo : photos) {
    if (photo.faces.empty()) continue;
    faces.push_back(&photo.faces[photo.largest]);
  }
  share_person(faces, impl_->options,
               [this](const lighting::Observations& observations, bool ask_prior, const lighting::SolveOptions& solve) {
                 return impl_->light_of(observations, ask_prior, solve);
               });
  for (Estimate& photo : photos) {
    if (photo.faces.size() < 2 || !photo.faces[photo.largest].same_person) continue;
    photo.warnings.push_back("The photo has " + std::to_string(photo.faces.size()) +
                             " faces; the largest is taken for the person of the other photos.");
    photo.joint = joint_of(photo);
  }
  watch.lap("same person");
  for (Estimate& photo : photos)
    photo.timings.push_back({times.front().stage, times.front().seconds / static_cast<double>(photos.size())});
}

LightResult Estimator::joint_of(const Estimate& photo) const {
  std::vector<FaceEvidence> evidence;
  for (const FaceEstimate& face : photo.faces) evidence.push_back(evidence_of(face));
  return joint(evidence);
}

Estimate Estimator::estimate(const io::Photo& photo, const StageDone& stage_done) const {
  Estimate out;
  Stopwatch watch(out.timings, stage_done);
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
    if (!impl_->options.classical && !estimate.enough_shown) {
      out.warnings.emplace_back(
          "The photo cuts off too much of a face; its highlights come from a classical separator, because the network "
          "needs more of a head.");
    }
    if (estimate.observations.count() < 30) {
      out.warnings.push_back("A face " + std::to_string(static_cast<int>(estimate.face.box.width)) +
                             " px wide shows too little skin to read light from and was left out.");
      continue;
    }
    out.faces.push_back(std::move(estimate));
  }
  if (out.faces.empty()) throw Error(ExitCode::kNoFace, "Every face found shows too little skin to read light from.");
  const bool says_so = photo.grey && impl_->options.classical;  // below, of the photo
  for (const FaceEstimate& face : out.faces) {
    std::optional<std::string> warning;
    if (!says_so) warning = no_highlights_warning(face, impl_->options.solve.solver);
    if (warning) out.warnings.push_back(*std::move(warning));
  }
  const auto area = [](const FaceEstimate& f) { return f.face.box.area(); };
  out.largest =
      static_cast<std::size_t>(std::max_element(out.faces.begin(), out.faces.end(),
                                                [&](const auto& a, const auto& b) { return area(a) < area(b); }) -
                               out.faces.begin());
  if (says_so) {
    out.warnings.emplace_back(
        impl_->options.solve.solver == lighting::Solver::kPaper
            ? "The photo is grey: the classical separators need colour and the paper's solver reads highlights only, "
              "so the map is black."
            : "The photo is grey: the classical separators need colour, so the light comes from shading alone.");
  }
  if (out.faces.size() > 1) {
    out.joint = joint_of(out);
    watch.lap("joint light");
  }
  return out;
}

}  // namespace faceprobe::pipeline

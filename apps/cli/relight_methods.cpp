#include "relight_methods.h"

#include "face_light_methods.h"
#include "faceprobe/pipeline/estimate.h"
#include "faceprobe/pipeline/observe.h"
#include "shared_estimate.h"

#include <optional>
#include <utility>

namespace faceprobe::cli {

namespace {

using pipeline::EstimateOptions;
using pipeline::FaceEstimate;
using SharedPtr = std::shared_ptr<SharedEstimate>;

face::FaceGeometry true_geometry(const eval::LightInput& input) {
  const synth::ViewLayers& view = input.view;
  const int width = view.region.width();
  const int height = view.region.height();
  face::FaceGeometry geometry;
  geometry.crop = {.x_px = 0, .y_px = 0, .scale = 1, .width = width, .height = height};
  geometry.normal_cam = view.normal;
  geometry.position_cam_m = geometry.view_cam = Image(width, height, 3);
  geometry.region = ByteImage(width, height, 1);
  geometry.normal_error_rad = Image(width, height, 1, 0.01F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3f towards = input.photo.camera.view_direction(x + 0.5, y + 0.5).cast<float>();
      Eigen::Map<Eigen::Vector3f>(geometry.view_cam.pixel(x, y)) = towards;
      if (view.owner(x, y) == 0) continue;
      geometry.region(x, y) = view.region(x, y);
      Eigen::Map<Eigen::Vector3f>(geometry.position_cam_m.pixel(x, y)) = -towards * (view.depth_m(x, y) / towards.z());
    }
  }
  return geometry;
}

// Everything known but the light: what is left is what a face can tell.
eval::LightMethod all_known(const EstimateOptions& options) {
  return {"all layers and normals known, without the prior",
          [options](const eval::LightInput& input) -> Eigen::MatrixX3f {
            const face::FaceGeometry geometry = true_geometry(input);
            const ByteImage no_flags(geometry.region.width(), geometry.region.height(), 1);
            const lighting::Observations o = pipeline::observe(geometry, input.sample.highlight, input.sample.shading,
                                                               no_flags, options.max_patches, options.threads);
            lighting::SolveOptions solve = options.solve;
            solve.highlight_weight = 1;
            solve.max_leak = 0;
            return o.count() == 0 ? Eigen::MatrixX3f() : lighting::solve(o, solve).radiance;
          }};
}

// The estimate with a part of it known.
eval::LightMethod partly_known(const std::string& name, const SharedPtr& shared, bool normals, bool layers) {
  return {name, [=](const eval::LightInput& input) -> Eigen::MatrixX3f {
            const FaceEstimate* face = shared->of(input);
            if (face == nullptr) return {};
            face::FaceGeometry geometry = face->geometry;
            if (normals) {
              geometry.normal_cam = face::crop_picture(input.view.normal, geometry.crop);
              for (std::size_t i = 0; i < geometry.normal_cam.values().size(); i += 3) {
                Eigen::Map<Eigen::Vector3f> normal(geometry.normal_cam.data() + i);
                if (normal.norm() > 0) normal.normalize();
              }
              geometry.normal_error_rad = Image(geometry.crop.width, geometry.crop.height, 1, 0.01F);
            }
            const Image highlight =
                layers ? face::crop_picture(input.sample.highlight, geometry.crop) : face->layers.highlight;
            const Image shading = layers ? face::crop_picture(input.sample.shading, geometry.crop) : face->shading;
            const ByteImage flags = layers ? ByteImage(geometry.crop.width, geometry.crop.height, 1) : face->clipped;
            const EstimateOptions& options = shared->options();
            return shared
                ->light_of(pipeline::observe(geometry, highlight, shading, flags, options.max_patches, options.threads))
                .radiance;
          }};
}

// What stands beside the whole estimate everywhere.
eval::LightMethod without_prior(const SharedPtr& shared) {
  return other_solver("transport without the prior", shared, [shared](const lighting::Observations& o) {
    return lighting::solve(o, shared->options().solve).radiance;
  });
}

eval::LightMethod by_paper(const SharedPtr& shared) {
  lighting::SolveOptions paper = shared->options().solve;
  paper.solver = lighting::Solver::kPaper;
  paper.threads = shared->options().threads;
  return other_solver("paper", shared,
                      [paper](const lighting::Observations& o) { return lighting::solve(o, paper).radiance; });
}

eval::LightMethod on_photos(const FaceLightMethod& method, const SharedPtr& shared) {
  return {method.name, [method, shared](const eval::LightInput& input) {
            const FaceEstimate* face = shared->of(input);
            return face == nullptr ? Eigen::MatrixX3f() : method.light({*face, input.photo.linear});
          }};
}

}  // namespace

Eigen::MatrixX3f mean_training_light(const std::filesystem::path& training, int nside) {
  constexpr int kPhotos = 1000;
  return eval::mean_light(synth::ShardReader(training), kPhotos, nside);
}

std::vector<eval::LightMethod> insert_methods(const RelightRows& rows) {
  const auto shared = std::make_shared<SharedEstimate>(estimate_options(rows));
  const auto grid = std::make_shared<SphereGrid>(rows.nside);
  return {whole("transport", shared), without_prior(shared), by_paper(shared),
          on_photos(harmonics_of_shading(rows.nside), shared),
          other_solver("ambient, as bright as the shading", shared, [grid](const lighting::Observations& o) {
            const Eigen::RowVector3f level = (o.weight.transpose() * o.shading) / o.weight.sum();
            return Eigen::MatrixX3f(level.replicate(grid->cell_count(), 1));
          })};
}

std::vector<eval::LightMethod> relight_methods(const RelightRows& rows) {
  const EstimateOptions options = estimate_options(rows);
  const auto shared = std::make_shared<SharedEstimate>(options);
  std::vector<eval::LightMethod> methods;
  methods.push_back(whole("transport", shared));
  methods.push_back(without_prior(shared));
  methods.push_back(by_paper(shared));
  methods.push_back(all_known(options));
  if (rows.ablation) {
    EstimateOptions mesh = options;
    mesh.normals = pipeline::NormalSource::kMesh;
    methods.push_back(whole("normals of the mesh", std::make_shared<SharedEstimate>(mesh)));
    methods.push_back(partly_known("normals known", shared, true, false));
    methods.push_back(partly_known("layers known", shared, false, true));
  }
  methods.push_back(on_photos(harmonics_of_shading(rows.nside), shared));
  if (!rows.training.empty()) {
    if (const std::optional<FaceLightMethod> learnt = learnt_transfer(rows.training, rows.nside))
      methods.push_back(on_photos(*learnt, shared));
  }
  methods.push_back(on_photos(joint_estimate(rows.nside, shared->options().threads), shared));
  methods.push_back(on_photos(lamp_at_brightest_highlight(rows.nside), shared));
  if (!rows.training.empty()) {
    methods.push_back(eval::constant_method(kMeanLight, mean_training_light(rows.training, rows.nside)));
  }
  methods.push_back(eval::ambient_method(rows.nside));
  methods.push_back(eval::harmonics_method(2, rows.nside));
  methods.push_back(eval::harmonics_method(5, rows.nside));
  return methods;
}

}  // namespace faceprobe::cli

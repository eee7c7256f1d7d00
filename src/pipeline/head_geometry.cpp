#include "faceprobe/pipeline/head_geometry.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/vertex_normals.h"
#include "faceprobe/pipeline/dense_landmarks.h"
#include "pipeline/head_fit.h"
#include "pipeline/unwrap_raster.h"

#include <memory>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {

namespace {

struct FittedModel {
  synth::HeadModel model;
  LandmarkPairs pairs;
  std::vector<int> skin;  // triangles
  int threads;

  // `geometry` is the mesh's.
  void draw(const face::Face& face, const face::Camera& camera, face::FaceGeometry& geometry) const {
    const HeadFit fit = fit_head(model, pairs, face, camera);
    const Eigen::MatrixX3f normals = vertex_normals(fit.vertices_cam, model.triangles);
    const Eigen::MatrixX3f points = picture_points(fit, pairs, face, camera, geometry.crop, threads);
    const MeshRaster seen = raster_mesh(points, model.triangles, skin, geometry.crop.width, geometry.crop.height);
    for (int y = 0; y < seen.height; ++y) {
      for (int x = 0; x < seen.width; ++x) {
        const RasterCell& cell = seen.at(x, y);
        if (cell.triangle < 0 || geometry.region(x, y) == 0) continue;
        const Eigen::RowVector3i corners = model.triangles.row(cell.triangle);
        const Eigen::Vector3f normal =
            (cell.weights.transpose() * normals(corners, Eigen::all)).transpose().normalized();
        if (normal.dot(Eigen::Map<const Eigen::Vector3f>(geometry.view_cam.pixel(x, y))) <= 0)
          continue;  // a fold's inside
        Eigen::Map<Eigen::Vector3f>(geometry.normal_cam.pixel(x, y)) = normal;
        Eigen::Map<Eigen::Vector3f>(geometry.position_cam_m.pixel(x, y)) =
            (cell.weights.transpose() * fit.vertices_cam(corners, Eigen::all)).transpose();
      }
    }
  }
};

void locate_landmarks(synth::HeadModel& model, const face::FaceFinder& finder) {
  if (!model.dense_landmarks.empty()) return;
  try {
    model.dense_landmarks = locate_dense_landmarks(model, finder);
  } catch (const Error&) {
    if (model.landmarks.empty()) throw;  // else landmark_pairs() takes the 68
  }
}

}  // namespace

face::SurfaceFit head_geometry(synth::HeadModel model, const face::FaceFinder& finder, int threads) {
  auto fitted = std::make_shared<FittedModel>();
  for (int t = 0; t < model.triangles.rows(); ++t) {
    if (model.triangle_material[static_cast<std::size_t>(t)] == synth::Material::kSkin) fitted->skin.push_back(t);
  }
  if (fitted->skin.empty())
    throw Error(ExitCode::kModel, "The head model " + model.name + " has no skin whose normals could be read.");
  locate_landmarks(model, finder);
  fitted->pairs = landmark_pairs(model);
  fitted->model = std::move(model);
  fitted->threads = threads;
  return [fitted = std::shared_ptr<const FittedModel>(std::move(fitted))](
             const face::Face& face, const face::Camera& camera, face::FaceGeometry& geometry) {
    fitted->draw(face, camera, geometry);
  };
}

}  // namespace faceprobe::pipeline

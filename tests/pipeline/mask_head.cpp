#include "pipeline/mask_head.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/vertex_normals.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"
#include "pipeline/unwrap_raster.h"

#include <Eigen/Geometry>
#include <numeric>

namespace faceprobe::pipeline::testing {

synth::HeadModel mask_head() {
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  synth::HeadModel model;
  model.name = "mask";
  model.neutral = mesh.vertices_m;
  model.triangles = mesh.triangles;
  model.triangle_material.assign(static_cast<std::size_t>(mesh.triangles.rows()), synth::Material::kSkin);
  model.uv = mesh.uv;
  model.triangle_uv = mesh.triangles;
  model.uv_layout = synth::UvLayout::kOwn;
  model.vertex_region.assign(face::kMeshVertices, Region::kCheeks);
  model.dense_landmarks.resize(face::kMeshVertices);
  for (int t = 0; t < model.triangles.rows(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      model.dense_landmarks[static_cast<std::size_t>(model.triangles(t, corner))] = {t, Eigen::Vector3f::Unit(corner)};
    }
  }
  return model;
}

MaskPhoto mask_photo(double yaw_deg, const Radiance& radiance) {
  static constexpr int kSide = 512;
  const synth::HeadModel model = mask_head();
  MaskPhoto out;
  out.camera = {.focal_px = 700, .centre_x_px = kSide / 2.0, .centre_y_px = kSide / 2.0};
  out.face.camera_from_face =
      Eigen::Translation3d(0, 0, -0.5) * Eigen::AngleAxisd(radians(yaw_deg), Eigen::Vector3d::UnitY());
  out.face.vertices_cam_m =
      (model.neutral.cast<double>() * out.face.camera_from_face.linear().transpose()).cast<float>();
  out.face.vertices_cam_m.rowwise() += out.face.camera_from_face.translation().transpose().cast<float>();
  out.face.landmarks_px.resize(face::kMeshVertices, 3);
  Eigen::MatrixX3f points(face::kMeshVertices, 3);
  for (int v = 0; v < face::kMeshVertices; ++v) {
    points.row(v).head<2>() =
        out.camera.project(out.face.vertices_cam_m.row(v).transpose().cast<double>()).cast<float>();
    points(v, 2) = -out.face.vertices_cam_m(v, 2);
  }
  out.face.landmarks_px = points;
  const Eigen::RowVector2f low = points.leftCols<2>().colwise().minCoeff();
  const Eigen::RowVector2f high = points.leftCols<2>().colwise().maxCoeff();
  out.face.box = {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  out.face.score = 1;

  std::vector<int> all(static_cast<std::size_t>(model.triangles.rows()));
  std::iota(all.begin(), all.end(), 0);
  const MeshRaster raster = raster_mesh(points, model.triangles, all, kSide, kSide);
  const Eigen::MatrixX3f normals = vertex_normals(out.face.vertices_cam_m, model.triangles);
  out.photo.linear = Image(kSide, kSide, 3, 0.05F);
  out.photo.clipped = ByteImage(kSide, kSide, 1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const RasterCell& cell = raster.at(x, y);
      if (cell.triangle < 0) continue;
      const Eigen::RowVector3i corners = model.triangles.row(cell.triangle);
      const Eigen::Vector2f uv = (cell.weights.transpose() * model.uv(corners, Eigen::all)).transpose();
      const Eigen::Vector3f normal = (cell.weights.transpose() * normals(corners, Eigen::all)).transpose().normalized();
      Eigen::Map<Eigen::Vector3f>(out.photo.linear.pixel(x, y)) = radiance(uv, normal);
    }
  }
  return out;
}

}  // namespace faceprobe::pipeline::testing

#pragma once
// A photo with a face and a thing to put into it, made up: what insertion is tested with.

#include "faceprobe/core/vertex_normals.h"
#include "faceprobe/insert/insert.h"
#include "faceprobe/pipeline/insertion.h"
#include "pipeline/portrait.h"

namespace faceprobe::pipeline::testing {

inline constexpr float kDepthM = 0.8F;  // of the face that only_face() has

inline EnvMap even_map(float value) { return EnvMap(Image(32, 16, 3, value)); }

inline FaceEstimate face_at(const Eigen::Vector3d& place_m, float box_x, float box_width) {
  FaceEstimate face;
  face.face.camera_from_face.translation() = place_m;
  face.face.box = {box_x, 100, box_width, 1.2F * box_width};
  face.environment = even_map(1);
  return face;
}

// One upright face whose box begins there.
inline Estimate only_face(float box_x, int width = 640, int height = 480) {
  Estimate estimate;
  estimate.photo_width = width;
  estimate.photo_height = height;
  estimate.camera = {800, 0.5 * width, 0.5 * height};
  estimate.faces.push_back(face_at({0, 0, -kDepthM}, box_x, 120));
  return estimate;
}

inline io::Photo photo_of(const Estimate& estimate) {
  return testing::blank(estimate.photo_width, estimate.photo_height);
}

// Vertices 0 to 3: foot, crown, front and right. 4 and 5 keep the box even about the foot.
inline render::Model marker() {
  render::TriangleMesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << 0, 0, 0, 0, 2, 0, 0, 0, 1, 1, 0, 0, 0, 0, -1, -1, 0, 0;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 1, 2, 3, 1, 3, 4, 1, 4, 5, 1, 5, 2;
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  return {{mesh}, {render::material_preset("diffuse")}};
}
inline Eigen::Vector3f vertex(const insert::Scene& scene, int i) {
  return scene.model.meshes[0].vertices.row(i).transpose();
}

inline Eigen::Vector2d pixel_of(const render::PinholeView& view, const Eigen::Vector3f& point) {
  return face::Camera{view.focal_px, view.centre_x_px, view.centre_y_px}.project(point.cast<double>());
}

}  // namespace faceprobe::pipeline::testing

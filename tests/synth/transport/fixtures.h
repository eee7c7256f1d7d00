#pragma once
// Plain shapes for the tests of light transport.

#include "faceprobe/core/angles.h"
#include "faceprobe/synth/transport.h"

#include <Eigen/Geometry>
#include <vector>

namespace faceprobe::synth {

// A ball of rings x (2 rings) vertices, its poles closed by fans, with exact normals.
inline SurfaceMesh ball(float radius, int rings, const Eigen::Vector3f& centre = Eigen::Vector3f::Zero()) {
  const int around = 2 * rings;
  SurfaceMesh mesh;
  mesh.material = Material::kObject;
  mesh.normals.resize(rings * around + 2, 3);
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < around; ++k) {
      const double theta = kPi * (i + 1) / (rings + 1);
      const double phi = 2 * kPi * k / around;
      mesh.normals.row(i * around + k) =
          Eigen::RowVector3d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi))
              .cast<float>();
    }
  }
  const int top = rings * around;
  mesh.normals.row(top) << 0, 1, 0;
  mesh.normals.row(top + 1) << 0, -1, 0;
  mesh.vertices = (radius * mesh.normals).rowwise() + centre.transpose();
  std::vector<Eigen::RowVector3i> triangles;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    triangles.emplace_back(top, k, next);
    triangles.emplace_back(top + 1, (rings - 1) * around + next, (rings - 1) * around + k);
    for (int i = 0; i + 1 < rings; ++i) {
      const int a = i * around + k;
      const int b = i * around + next;
      triangles.emplace_back(a, a + around, b);
      triangles.emplace_back(b, a + around, b + around);
    }
  }
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) mesh.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return mesh;
}

// A square of n x n pieces in the plane z = `z`, facing +z.
inline SurfaceMesh wall(float half_width, int n, float z) {
  SurfaceMesh mesh;
  mesh.material = Material::kObject;
  mesh.vertices.resize((n + 1) * (n + 1), 3);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const auto at = [&](int k) { return half_width * (2.0F * static_cast<float>(k) / static_cast<float>(n) - 1.0F); };
      mesh.vertices.row(j * (n + 1) + i) << at(i), at(j), z;
    }
  }
  mesh.normals = Eigen::RowVector3f(0, 0, 1).replicate(mesh.vertices.rows(), 1);
  mesh.triangles.resize(2 * n * n, 3);
  for (int j = 0, t = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.triangles.row(t++) << a, a + 1, a + n + 1;
      mesh.triangles.row(t++) << a + 1, a + n + 2, a + n + 1;
    }
  }
  return mesh;
}

// Turns a mesh inside out.
inline SurfaceMesh inverted(SurfaceMesh mesh) {
  mesh.normals = -mesh.normals;
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

inline Scene scene_of(std::vector<SurfaceMesh> meshes, std::vector<Strands> strands = {}) {
  Figure figure;
  figure.meshes = std::move(meshes);
  figure.strands = std::move(strands);
  return Scene({figure});
}

// On the +z axis, looking at the origin; a square picture that shows `half_width` metres to each side there.
inline PinholeCamera camera_at(float distance, float half_width, int size) {
  PinholeCamera camera;
  camera.width_px = camera.height_px = size;
  camera.centre_px.setConstant(0.5F * static_cast<float>(size));
  camera.focal_px = 0.5F * static_cast<float>(size) * distance / half_width;
  camera.camera_from_scene.translation().z() = -distance;
  return camera;
}

// A scene seen and ready to be lit.
struct Stage {
  Scene scene;
  SceneTransport transport;
  ViewTransport view;
};

inline Stage make_stage(Scene scene, const PinholeCamera& camera, float roughness = 0.3F,
                        const TransportOptions& options = {}, float f0 = 0.04F) {
  Fragments seen = find_fragments(scene, camera, {.samples_per_side = 2, .threads = options.threads});
  SceneTransport transport = build_scene_transport(scene, vertices_seen(std::vector{&std::as_const(seen)}), options);
  FragmentSurface surface{seen.normal, Eigen::VectorXf::Constant(seen.count(), roughness),
                          Eigen::VectorXf::Constant(seen.count(), f0)};
  ViewTransport view = build_view_transport(scene, transport, std::move(seen), std::move(surface),
                                            camera.camera_from_scene.inverse().translation(), options);
  return {std::move(scene), std::move(transport), std::move(view)};
}

inline LightSample even_light(const Stage& stage, float radiance) {
  LightSample light;
  light.cells = Eigen::MatrixX3f::Constant(stage.transport.diffuse.cols(), 3, radiance);
  return light;
}

inline FragmentLight light_up(const Stage& stage, const LightSample& light, const ShadeOptions& options = {}) {
  return shade(stage.scene, stage.transport, stage.view, std::vector{light}, options).front();
}

// The fragment nearest to a place.
inline int fragment_at(const Stage& stage, const Eigen::Vector3f& place) {
  Eigen::Index at = 0;
  (stage.view.fragments.position.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&at);
  return static_cast<int>(at);
}

}  // namespace faceprobe::synth

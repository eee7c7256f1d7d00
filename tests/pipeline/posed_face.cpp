#include "pipeline/posed_face.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/skin_reflectance.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/data_files.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace faceprobe::pipeline::testing {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
const face::Camera kCamera{700, kWidth / 2.0, kHeight / 2.0};
const Eigen::Vector3f kSkin(0.52F, 0.33F, 0.24F);
const Eigen::Vector3f kLips(0.38F, 0.18F, 0.16F);

const face::CanonicalMesh& mesh() {
  static const face::CanonicalMesh one = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  return one;
}

// Moeller & Trumbore 1997, both sides of the triangle.
bool meets(const Eigen::Vector3f& from, const Eigen::Vector3f& along, const Eigen::Matrix3f& triangle) {
  const Eigen::Vector3f e1 = triangle.col(1) - triangle.col(0);
  const Eigen::Vector3f e2 = triangle.col(2) - triangle.col(0);
  const Eigen::Vector3f p = along.cross(e2);
  const float determinant = e1.dot(p);
  if (std::abs(determinant) < 1e-12F) return false;
  const Eigen::Vector3f s = (from - triangle.col(0)) / determinant;
  const float u = s.dot(p);
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3f q = s.cross(e1);
  const float v = along.dot(q);
  constexpr float kNearest = 2e-3F;  // metres: smooth normals see around the edge of their own flat triangle
  return v >= 0 && u + v <= 1 && e2.dot(q) > kNearest;
}

Microfacet skin_at(const face::FaceGeometry& geometry, int x, int y) {
  const SkinReflectance skin = skin_reflectance(static_cast<Region>(geometry.region(x, y)));
  return {.roughness = skin.roughness, .specular_albedo = skin.specular_albedo};
}

bool is_skin(const face::FaceGeometry& geometry, int x, int y) {
  return faceprobe::is_skin(static_cast<Region>(geometry.region(x, y)));
}

}  // namespace

PosedFace posed_face(double yaw_deg) {
  PosedFace out;
  face::Face& face = out.face;
  face.camera_from_face.linear() = Eigen::AngleAxisd(radians(yaw_deg), Eigen::Vector3d::UnitY()).toRotationMatrix();
  face.camera_from_face.translation() = Eigen::Vector3d(0.02, 0.01, -0.6);
  face.vertices_cam_m = (face.camera_from_face * mesh().vertices_m.cast<double>().transpose()).transpose().cast<float>();
  Eigen::AlignedBox2d box;
  for (const auto& vertex : face.vertices_cam_m.rowwise())
    box.extend(kCamera.project(vertex.transpose().cast<double>()));
  const Eigen::Vector2f corner = box.min().cast<float>();
  const Eigen::Vector2f size = box.sizes().cast<float>();
  face.box = {corner.x(), corner.y(), size.x(), size.y()};
  const face::GeometryOptions options;
  out.geometry = face::rasterize(face, kCamera, mesh(), face::face_crop(face, kWidth, kHeight, options));
  return out;
}

LitFace light_up(const PosedFace& posed, const std::vector<Lamp>& lamps, float ambient_radiance) {
  const face::FaceGeometry& g = posed.geometry;
  std::vector<Eigen::Matrix3f> triangles;
  for (const auto& corners : mesh().triangles.rowwise()) {
    Eigen::Matrix3f& triangle = triangles.emplace_back();
    for (int k = 0; k < 3; ++k) triangle.col(k) = posed.face.vertices_cam_m.row(corners(k)).transpose();
  }
  const SphereGrid sky(4);
  LitFace lit{Image(g.region.width(), g.region.height(), 3), Image(g.region.width(), g.region.height(), 3)};
  for (int y = 0; y < g.region.height(); ++y) {
    for (int x = 0; x < g.region.width(); ++x) {
      if (!is_skin(g, x, y)) continue;
      const Eigen::Vector3f normal(g.normal_cam.pixel(x, y));
      const Eigen::Vector3f view(g.view_cam.pixel(x, y));
      const Eigen::Vector3f position(g.position_cam_m.pixel(x, y));
      Eigen::Map<Eigen::Vector3f> highlight(lit.highlight.pixel(x, y));
      Eigen::Map<Eigen::Vector3f> shading(lit.shading.pixel(x, y));
      shading.setConstant(ambient_radiance);
      const auto cell = static_cast<float>(sky.cell_solid_angle());
      for (int j = 0; j < sky.cell_count(); ++j) {
        highlight.array() += ambient_radiance * cell * specular_lobe(normal, view, sky.direction(j), skin_at(g, x, y));
      }
      for (const Lamp& lamp : lamps) {
        const Eigen::Vector3f towards = lamp.direction.cast<float>();
        if (normal.dot(towards) <= 0) continue;
        const bool shadowed = std::any_of(triangles.begin(), triangles.end(),
                                          [&](const Eigen::Matrix3f& t) { return meets(position, towards, t); });
        if (shadowed) continue;
        highlight += specular_lobe(normal, view, towards, skin_at(g, x, y)) * lamp.irradiance;
        shading += normal.dot(towards) / static_cast<float>(kPi) * lamp.irradiance;
      }
    }
  }
  return lit;
}

Image photograph(const PosedFace& posed, const LitFace& lit) {
  Image photo(lit.shading.width(), lit.shading.height(), 3);
  for (int y = 0; y < photo.height(); ++y) {
    for (int x = 0; x < photo.width(); ++x) {
      const bool lips = posed.geometry.region(x, y) == static_cast<int>(Region::kLips);
      for (int c = 0; c < 3; ++c) {
        photo(x, y, c) = (lips ? kLips : kSkin)[c] * lit.shading(x, y, c) + lit.highlight(x, y, c);
      }
    }
  }
  return photo;
}

Eigen::Vector3d energy_centroid(const Eigen::MatrixX3f& radiance, const Eigen::MatrixX3f& directions) {
  const Eigen::VectorXd energy = (radiance * kLuminanceWeights).cast<double>();
  return (directions.cast<double>().transpose() * energy).normalized();
}

}  // namespace faceprobe::pipeline::testing

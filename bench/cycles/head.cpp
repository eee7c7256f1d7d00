#include "cycles/head.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/vertex_normals.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace faceprobe::bench {

namespace {

constexpr int kModelVertices = 26719;
constexpr int kSolidVertices = 24591;  // skin, sockets, gums, teeth, eyeballs; shells and lashes follow
constexpr float kMetresPerUnit = 0.01F;
// Corners of the eyes in the 68-landmark order's 36, 39, 42, 45.
constexpr int kEyeCorners[] = {1507, 1528, 3742, 3721};

}  // namespace

synth::SurfaceMesh load_head(const std::filesystem::path& data) {
  const std::filesystem::path path = data / "faces" / "ict_facekit" / "generic_neutral_mesh.obj";
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::kInput, "Cannot read the head mesh " + path.string() + ".");
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3f v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back(v * kMetresPerUnit);
    } else if (kind == "f") {
      std::vector<int> polygon;
      std::string corner;
      while (words >> corner) polygon.push_back(std::stoi(corner) - 1);
      if (std::any_of(polygon.begin(), polygon.end(), [](int i) { return i < 0 || i >= kSolidVertices; })) continue;
      for (std::size_t k = 2; k < polygon.size(); ++k) {
        triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
      }
    }
  }
  if (vertices.size() != kModelVertices || triangles.empty()) {
    throw Error(ExitCode::kInput, path.string() + " has " + std::to_string(vertices.size()) +
                                      " vertices; ICT FaceKit's head has " + std::to_string(kModelVertices) + ".");
  }
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  for (const int corner : kEyeCorners) origin += vertices[static_cast<std::size_t>(corner)] / 4.0F;

  synth::SurfaceMesh mesh;
  mesh.vertices.resize(kSolidVertices, 3);
  for (int i = 0; i < kSolidVertices; ++i)
    mesh.vertices.row(i) = (vertices[static_cast<std::size_t>(i)] - origin).transpose();
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t].transpose();
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  mesh.vertex_region.assign(kSolidVertices, Region::kOther);
  return mesh;
}

synth::PinholeCamera head_camera(int size_px) {
  constexpr float kDistance = 0.8F;
  constexpr float kFieldAtHead = 0.27F;  // metres
  synth::PinholeCamera camera;
  camera.width_px = camera.height_px = size_px;
  camera.focal_px = static_cast<float>(size_px) * kDistance / kFieldAtHead;
  camera.centre_px = Eigen::Vector2f::Constant(static_cast<float>(size_px) / 2.0F);
  const Eigen::Matrix3f turn = (Eigen::AngleAxisf(static_cast<float>(radians(8.0)), Eigen::Vector3f::UnitX()) *
                                Eigen::AngleAxisf(static_cast<float>(radians(22.0)), Eigen::Vector3f::UnitY()))
                                   .toRotationMatrix();
  const Eigen::Vector3f target(0.0F, -0.025F, -0.02F);
  camera.camera_from_scene.linear() = turn;
  camera.camera_from_scene.translation() = Eigen::Vector3f(0.0F, 0.0F, -kDistance) - turn * target;
  return camera;
}

synth::SurfaceMesh in_camera_frame(synth::SurfaceMesh mesh, const synth::PinholeCamera& camera) {
  const Eigen::Matrix3f turn = camera.camera_from_scene.linear();
  mesh.normals = mesh.normals * turn.transpose();
  mesh.vertices = (mesh.vertices * turn.transpose()).rowwise() + camera.camera_from_scene.translation().transpose();
  return mesh;
}

}  // namespace faceprobe::bench

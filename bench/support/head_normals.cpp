#include "support/head_normals.h"

#include "faceprobe/core/error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

namespace faceprobe::bench {

namespace {

struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

Mesh read_obj(const std::filesystem::path& path, int vertex_limit) {
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::kInput, "Cannot read the head mesh " + path.string() + ".");
  Mesh mesh;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3f v;
      words >> v.x() >> v.y() >> v.z();
      mesh.vertices.push_back(v);
    } else if (kind == "f") {
      std::vector<int> polygon;
      std::string corner;
      while (words >> corner) polygon.push_back(std::stoi(corner) - 1);
      if (vertex_limit > 0 && std::any_of(polygon.begin(), polygon.end(), [&](int i) { return i >= vertex_limit; }))
        continue;
      for (std::size_t k = 2; k < polygon.size(); ++k)
        mesh.triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
    }
  }
  if (mesh.triangles.empty()) throw Error(ExitCode::kInput, path.string() + " holds no faces.");
  return mesh;
}

}  // namespace

lighting::Observations head_observations(const std::filesystem::path& obj, int long_side_px, int vertex_limit) {
  const Mesh mesh = read_obj(obj, vertex_limit);
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size(), Eigen::Vector3f::Zero());
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3f& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3f& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const Eigen::Vector3f area = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) {
      normals[static_cast<std::size_t>(t[k])] += area;
      low = low.cwiseMin(mesh.vertices[static_cast<std::size_t>(t[k])]);
      high = high.cwiseMax(mesh.vertices[static_cast<std::size_t>(t[k])]);
    }
  }
  const float scale = static_cast<float>(long_side_px) / (high.y() - low.y());
  const int width = static_cast<int>((high.x() - low.x()) * scale) + 1;
  const int height = long_side_px + 1;
  std::vector<float> depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                           -std::numeric_limits<float>::max());
  std::vector<Eigen::Vector3f> seen(depth.size(), Eigen::Vector3f::Zero());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    std::array<Eigen::Vector3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f& v = mesh.vertices[static_cast<std::size_t>(t[static_cast<int>(k)])];
      p[k] = {(v.x() - low.x()) * scale, (high.y() - v.y()) * scale, v.z()};
    }
    const float area = (p[1].x() - p[0].x()) * (p[2].y() - p[0].y()) - (p[1].y() - p[0].y()) * (p[2].x() - p[0].x());
    if (std::abs(area) < 1e-9F) continue;
    const int x0 = std::max(0, static_cast<int>(std::min({p[0].x(), p[1].x(), p[2].x()})));
    const int x1 = std::min(width - 1, static_cast<int>(std::max({p[0].x(), p[1].x(), p[2].x()})) + 1);
    const int y0 = std::max(0, static_cast<int>(std::min({p[0].y(), p[1].y(), p[2].y()})));
    const int y1 = std::min(height - 1, static_cast<int>(std::max({p[0].y(), p[1].y(), p[2].y()})) + 1);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const float px = static_cast<float>(x) + 0.5F;
        const float py = static_cast<float>(y) + 0.5F;
        const float u = ((p[1].x() - px) * (p[2].y() - py) - (p[1].y() - py) * (p[2].x() - px)) / area;
        const float v = ((p[2].x() - px) * (p[0].y() - py) - (p[2].y() - py) * (p[0].x() - px)) / area;
        const float w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        const float z = u * p[0].z() + v * p[1].z() + w * p[2].z();
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (z <= depth[at]) continue;
        depth[at] = z;
        seen[at] = u * normals[static_cast<std::size_t>(t[0])] + v * normals[static_cast<std::size_t>(t[1])] +
                   w * normals[static_cast<std::size_t>(t[2])];
      }
    }
  }
  std::vector<Eigen::Vector3f> visible;
  for (const Eigen::Vector3f& n : seen) {
    if (n.norm() > 0 && n.normalized().z() > 0.02F) visible.push_back(n.normalized());
  }
  lighting::Observations observations;
  observations.resize(static_cast<Eigen::Index>(visible.size()));
  for (std::size_t i = 0; i < visible.size(); ++i)
    observations.normal.row(static_cast<Eigen::Index>(i)) = visible[i].transpose();
  observations.view.rowwise() = Eigen::RowVector3f(0, 0, 1);
  return observations;
}

}  // namespace faceprobe::bench

#include "rounded_box.h"

#include "faceprobe/core/angles.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace faceprobe::render {
namespace {

constexpr int kBend = 6;  // steps from a flat to the middle of its edge
// Points along a side: 0..kBend bend, then comes the flat, then kBend + 1..kLast bend.
constexpr int kLast = 2 * kBend + 1;
constexpr int kPoints = kLast + 1;

// The surface of a lattice of kLast cells along each side, bent into shape.
class Surface {
 public:
  Surface(const Eigen::Vector3f& core, float radius)
      : core_(core), radius_(radius), known_(kPoints * kPoints * kPoints, -1) {}

  // The vertex of a lattice point; faces that meet share it.
  int vertex(const Eigen::Vector3i& point) {
    int& index = known_[static_cast<std::size_t>((point.z() * kPoints + point.y()) * kPoints + point.x())];
    if (index < 0) {
      index = static_cast<int>(positions_.size());
      add(point);
    }
    return index;
  }
  void copy_to(TriangleMesh& mesh) const {
    mesh.vertices.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    mesh.normals.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      mesh.vertices.row(static_cast<Eigen::Index>(v)) = positions_[v];
      mesh.normals.row(static_cast<Eigen::Index>(v)) = normals_[v];
    }
  }

 private:
  void add(const Eigen::Vector3i& point) {
    Eigen::Vector3f middle;
    Eigen::Vector3f off;
    for (int axis = 0; axis < 3; ++axis) {
      const bool low = point[axis] <= kBend;
      const int step = low ? point[axis] - kBend : point[axis] - kBend - 1;
      middle[axis] = low ? -core_[axis] : core_[axis];
      off[axis] = std::tan(static_cast<float>(step) / kBend * static_cast<float>(kPi / 4));  // equal angles
    }
    normals_.push_back(off.normalized());
    positions_.emplace_back(middle + radius_ * normals_.back());
  }

  Eigen::Vector3f core_;
  float radius_;
  std::vector<int> known_;
  std::vector<Eigen::Vector3f> positions_, normals_;
};

}  // namespace

TriangleMesh rounded_box(const Eigen::Vector3f& size, float radius) {
  const Eigen::Vector3f core = size / 2 - Eigen::Vector3f::Constant(radius);
  if (!(radius > 0 && core.minCoeff() > 0)) {
    throw std::invalid_argument("A box can be rounded by less than half of its shortest side.");
  }
  Surface surface(core, radius);
  TriangleMesh mesh;
  mesh.triangles.resize(6 * 2 * kLast * kLast, 3);
  int triangle = 0;
  for (int face = 0; face < 6; ++face) {
    const int axis = face % 3;
    const bool high = face < 3;
    // Right-handed about the outward direction.
    const int across = (axis + (high ? 1 : 2)) % 3;
    const int up = (axis + (high ? 2 : 1)) % 3;
    const auto vertex = [&](int x, int y) {
      Eigen::Vector3i point;
      point[axis] = high ? kLast : 0;
      point[across] = x;
      point[up] = y;
      return surface.vertex(point);
    };
    for (int y = 0; y < kLast; ++y) {
      for (int x = 0; x < kLast; ++x) {
        const int start = vertex(x, y);
        const int opposite = vertex(x + 1, y + 1);
        mesh.triangles.row(triangle++) = Eigen::RowVector3i(start, vertex(x + 1, y), opposite);
        mesh.triangles.row(triangle++) = Eigen::RowVector3i(start, opposite, vertex(x, y + 1));
      }
    }
  }
  surface.copy_to(mesh);
  return mesh;
}

}  // namespace faceprobe::render

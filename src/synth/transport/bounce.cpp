#include "synth/transport/bounce.h"

#include "faceprobe/core/parallel.h"
#include "synth/transport/vertex_mix.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr int kFarthestStandIn = 8;          // edges
constexpr float kLeastStandInCosine = 0.5F;  // between the normals of a vertex and the one that stands in for it

struct Entry {
  int column;
  float value;
};

// For every vertex of the scene the nearest row along its mesh, or -1. Rings grow from all vertices with a row at once.
std::vector<int> nearest_rows(const Scene& scene, const std::vector<int>& row_of_vertex,
                              const std::vector<int>& vertices) {
  const auto count = static_cast<std::size_t>(scene.vertex_count());
  std::vector<std::vector<int>> neighbours(count);
  for (std::size_t f = 0; f < scene.figures().size(); ++f) {
    const std::vector<SurfaceMesh>& meshes = scene.figures()[f].meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const int offset = scene.vertex_offset(static_cast<int>(f), static_cast<int>(m));
      for (Eigen::Index t = 0; t < meshes[m].triangles.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
          const int a = offset + meshes[m].triangles(t, k);
          neighbours[static_cast<std::size_t>(a)].push_back(offset + meshes[m].triangles(t, (k + 1) % 3));
        }
      }
    }
  }
  std::vector<int> nearest = row_of_vertex;
  std::vector<int> ring = vertices;
  for (int step = 0; step < kFarthestStandIn; ++step) {
    std::vector<int> next;
    for (const int from : ring) {
      for (const int to : neighbours[static_cast<std::size_t>(from)]) {
        if (nearest[static_cast<std::size_t>(to)] >= 0) continue;
        nearest[static_cast<std::size_t>(to)] = nearest[static_cast<std::size_t>(from)];
        next.push_back(to);
      }
    }
    ring = std::move(next);
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (row_of_vertex[v] >= 0 || nearest[v] < 0) continue;
    const int stand_in = vertices[static_cast<std::size_t>(nearest[v])];
    const float cosine = scene.normals().row(static_cast<Eigen::Index>(v)).dot(scene.normals().row(stand_in));
    if (cosine < kLeastStandInCosine) nearest[v] = -1;
  }
  return nearest;
}

class Gatherer {
 public:
  Gatherer(const Scene& scene, const SceneTransport& transport, const CellSet& cells, const std::vector<int>& nearest,
           int rays)
      : scene_(scene), transport_(transport), cells_(cells), nearest_(nearest), rays_(rays) {}

  // Rays go where the vertex does not see the sky, to cells drawn evenly in their weight, so that few are enough.
  std::vector<Entry> gather(int row, int vertex) {
    const Eigen::Vector3f normal = scene_.normals().row(vertex).transpose();
    const Eigen::Vector3f origin = scene_.vertices().row(vertex).transpose() + kRayOffset * normal;
    const std::uint8_t* share =
        transport_.visibility.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_.count);
    cells_.cosine_weights(normal, weights_);
    float blocked = 0;
    for (const int cell : cells_.order) {
      weights_(cell) *= 1.0F - static_cast<float>(share[cell]) / 255.0F;
      blocked += weights_(cell);
    }
    std::vector<Entry> entries;
    constexpr float kNothing = 1e-4F;
    if (rays_ <= 0 || blocked < kNothing) return entries;
    const int count = std::clamp(static_cast<int>(std::ceil(4.0F * blocked * static_cast<float>(rays_))), 1, rays_);
    int hits = 0;
    float passed = 0;
    int drawn = 0;
    for (const int cell : cells_.order) {
      passed += weights_(cell);
      for (; drawn < count && passed > (static_cast<float>(drawn) + 0.5F) / static_cast<float>(count) * blocked;
           ++drawn) {
        hits += follow(origin, above_surface(cells_.centre.row(cell).transpose(), normal), entries) ? 1 : 0;
      }
    }
    merge(entries, hits > 0 ? blocked / static_cast<float>(hits) : 0.0F);
    return entries;
  }

 private:
  bool follow(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, std::vector<Entry>& entries) const {
    const Hit hit = scene_.first_hit(origin, direction);
    if (hit.figure < 0) return false;
    if (hit.strand) return true;
    const SurfaceMesh& mesh =
        scene_.figures()[static_cast<std::size_t>(hit.figure)].meshes[static_cast<std::size_t>(hit.part)];
    const Eigen::RowVector3i corners = mesh.triangles.row(hit.primitive);
    const Eigen::RowVector3f a = mesh.vertices.row(corners(0));
    const Eigen::RowVector3f face = (mesh.vertices.row(corners(1)) - a).cross(mesh.vertices.row(corners(2)) - a);
    if (face.dot(direction.transpose()) >= 0) return true;  // the inside of something: dark
    const int offset = scene_.vertex_offset(hit.figure, hit.part);
    const float weights[3] = {1 - hit.u - hit.v, hit.u, hit.v};
    for (int k = 0; k < 3; ++k) {
      const int column = nearest_[static_cast<std::size_t>(offset + corners(k))];
      if (column >= 0) entries.push_back({column, weights[k]});
    }
    return true;
  }

  static void merge(std::vector<Entry>& entries, float scale) {
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (kept > 0 && entries[kept - 1].column == entries[i].column) {
        entries[kept - 1].value += entries[i].value;
      } else {
        entries[kept++] = entries[i];
      }
    }
    entries.resize(kept);
    for (Entry& entry : entries) entry.value *= scale;
  }

  const Scene& scene_;
  const SceneTransport& transport_;
  const CellSet& cells_;
  const std::vector<int>& nearest_;
  int rays_;
  Eigen::ArrayXf weights_;
};

}  // namespace

Eigen::SparseMatrix<float, Eigen::RowMajor> build_bounce(const Scene& scene, const SceneTransport& transport,
                                                         const std::vector<int>& vertices, const CellSet& cells,
                                                         int rays, int threads) {
  const std::vector<int> nearest = nearest_rows(scene, transport.row_of_vertex, vertices);
  std::vector<std::vector<Entry>> entries(vertices.size());
  parallel_for(static_cast<int>(vertices.size()), threads, [&](int first, int last) {
    Gatherer gatherer(scene, transport, cells, nearest, rays);
    for (int row = first; row < last; ++row) {
      entries[static_cast<std::size_t>(row)] = gatherer.gather(row, vertices[static_cast<std::size_t>(row)]);
    }
  });
  const auto size = static_cast<Eigen::Index>(vertices.size());
  Eigen::SparseMatrix<float, Eigen::RowMajor> bounce(size, size);
  std::size_t total = 0;
  for (const auto& row : entries) total += row.size();
  bounce.reserve(static_cast<Eigen::Index>(total));
  for (std::size_t row = 0; row < entries.size(); ++row) {
    bounce.startVec(static_cast<Eigen::Index>(row));
    for (const Entry& entry : entries[row])
      bounce.insertBack(static_cast<Eigen::Index>(row), entry.column) = entry.value;
  }
  bounce.finalize();
  return bounce;
}

Eigen::MatrixX3f bounced_shading(const SceneTransport& transport, const ViewTransport& view,
                                 const Eigen::MatrixX3f& vertex_shading, const Eigen::MatrixX3f& vertex_albedo) {
  // Channels side by side, so that each entry of the matrix is read once.
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Rows radiosity = vertex_shading.cwiseProduct(vertex_albedo);
  const Rows product = transport.bounce * radiosity;
  const Eigen::MatrixX3f gathered = product;
  Eigen::MatrixX3f out = Eigen::MatrixX3f::Zero(view.fragments.count(), 3);
  mix(view.fragments, mix_rows(transport, view.fragments), gathered, out);
  return out;
}

}  // namespace faceprobe::synth

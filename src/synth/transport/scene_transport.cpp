#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/transport.h"
#include "synth/transport/bounce.h"
#include "synth/transport/cell_set.h"
#include "synth/transport/coarse_cells.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr int kWhole = 255;

// Shares of the cells that one vertex sees. A ray through the middle of each coarse cell first; where neighbours differ, or the
// horizon is near, one through each cell in it; and where those differ, the edge of something is near and four rays decide. What is
// narrower than a coarse cell (7 degrees for nside 16) can hide between the first rays.
class SkyView {
 public:
  SkyView(const Scene& scene, const CellSet& cells, const CoarseCells& coarse)
      : scene_(scene), cells_(cells), coarse_(coarse), coarse_free_(static_cast<std::size_t>(coarse.cells.count)) {}

  void look(const Eigen::Vector3f& vertex, const Eigen::Vector3f& normal, std::uint8_t* share) {
    origin_ = vertex + kRayOffset * normal;
    normal_ = normal;
    std::fill_n(share, cells_.count, std::uint8_t{0});
    height_ = (cells_.centre * normal).array();
    coarse_height_ = (coarse_.cells.centre * normal).array();
    first_look(share);
    refine(share);
  }

 private:
  bool above(int cell) const { return height_(cell) > -std::sin(cells_.reach); }
  bool coarse_above(int cell) const { return coarse_height_(cell) > std::sin(coarse_.cells.reach); }

  void first_look(std::uint8_t* share) {
    start();
    for (const int cell : coarse_.cells.order) {
      if (coarse_above(cell)) add(cell, coarse_.cells.centre.row(cell).transpose());
    }
    trace();
    for (std::size_t i = 0; i < rays_.size(); ++i) coarse_free_[static_cast<std::size_t>(cell_[i])] = free_[i];
    start();
    for (const int cell : coarse_.cells.order) {
      const bool even =
          coarse_above(cell) && std::ranges::all_of(coarse_.around[static_cast<std::size_t>(cell)], [&](int o) {
            return coarse_above(o) &&
                   coarse_free_[static_cast<std::size_t>(o)] == coarse_free_[static_cast<std::size_t>(cell)];
          });
      for (const int child : coarse_.children[static_cast<std::size_t>(cell)]) {
        if (even) {
          share[child] = coarse_free_[static_cast<std::size_t>(cell)] != 0 ? kWhole : 0;
        } else if (above(child)) {
          add(child, cells_.centre.row(child).transpose());
        }
      }
    }
    trace();
    for (std::size_t i = 0; i < rays_.size(); ++i) share[cell_[i]] = free_[i] != 0 ? kWhole : 0;
  }

  void refine(std::uint8_t* share) {
    start();
    for (const int cell : cells_.order) {
      if (!above(cell)) continue;
      const bool edge = std::ranges::any_of(cells_.neighbour[static_cast<std::size_t>(cell)],
                                            [&](int other) { return above(other) && share[other] != share[cell]; });
      if (!edge) continue;
      for (int i = 0; i < CellSet::kQuarters; ++i)
        add(cell, cells_.quarters.row(CellSet::kQuarters * cell + i).transpose());
    }
    trace();
    for (std::size_t i = 0; i < rays_.size(); i += CellSet::kQuarters) {
      int seen = 0;
      for (std::size_t k = 0; k < CellSet::kQuarters; ++k) seen += free_[i + k];
      share[cell_[i]] = static_cast<std::uint8_t>((kWhole * seen + CellSet::kQuarters / 2) / CellSet::kQuarters);
    }
  }

  void start() {
    rays_.clear();
    cell_.clear();
  }
  void add(int cell, const Eigen::Vector3f& direction) {
    rays_.push_back({origin_, above_surface(direction, normal_)});
    cell_.push_back(cell);
  }
  void trace() {
    free_.resize(rays_.size());
    scene_.visible(rays_, free_.data());
  }

  const Scene& scene_;
  const CellSet& cells_;
  const CoarseCells& coarse_;
  std::vector<std::uint8_t> coarse_free_;
  Eigen::ArrayXf height_, coarse_height_;
  Eigen::Vector3f origin_, normal_;
  std::vector<ShadowRay> rays_;
  std::vector<int> cell_;
  std::vector<std::uint8_t> free_;
};

}  // namespace

Eigen::Vector3f above_surface(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
  constexpr float kLeastHeight = 0.01F;
  const float height = direction.dot(normal);
  if (height >= kLeastHeight) return direction;
  return (direction + (kLeastHeight - height) * normal).normalized();
}

std::vector<int> vertices_seen(std::span<const Fragments* const> views) {
  std::vector<int> out;
  for (const Fragments* view : views) {
    out.insert(out.end(), view->mix_vertex.begin(), view->mix_vertex.end());
    for (Eigen::Index i = 0; i < view->vertex.size(); ++i) {
      if (view->vertex(i) >= 0) out.push_back(view->vertex(i));
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

SceneTransport build_scene_transport(const Scene& scene, const std::vector<int>& vertices,
                                     const TransportOptions& options) {
  SceneTransport transport;
  transport.nside = options.nside;
  transport.row_of_vertex.assign(static_cast<std::size_t>(scene.vertex_count()), -1);
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    if (vertices[row] < 0 || vertices[row] >= scene.vertex_count()) {
      throw std::invalid_argument("A row was asked for a vertex that the scene does not have.");
    }
    transport.row_of_vertex[static_cast<std::size_t>(vertices[row])] = static_cast<int>(row);
  }
  const CellSet cells(options.nside);
  const CoarseCells coarse(options.nside);
  const auto rows = static_cast<int>(vertices.size());
  const auto shares_of = [&](int row) { return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.count); };
  transport.visibility.resize(shares_of(rows));
  const Eigen::MatrixX3f normals = scene.normals()(vertices, Eigen::all);
  parallel_for(rows, options.threads, [&](int first, int last) {
    SkyView sky(scene, cells, coarse);
    for (int row = first; row < last; ++row) {
      sky.look(scene.vertices().row(vertices[static_cast<std::size_t>(row)]).transpose(), normals.row(row).transpose(),
               transport.visibility.data() + shares_of(row));
    }
  });
  transport.diffuse = pack_rows(rows, cells.count, alike_rows(normals), options.threads, [&](int row, float* out) {
    Eigen::ArrayXf weights;
    cells.cosine_weights(normals.row(row).transpose(), weights);
    const Eigen::Map<const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>> share(
        transport.visibility.data() + shares_of(row), cells.count);
    Eigen::Map<Eigen::ArrayXf>(out, cells.count) = weights * share.cast<float>() * (1.0F / kWhole);
  });
  transport.bounce = build_bounce(scene, transport, vertices, cells, options.bounce_rays, options.threads);
  return transport;
}

}  // namespace faceprobe::synth

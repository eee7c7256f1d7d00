#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/transport.h"
#include "synth/transport/cell_set.h"
#include "synth/transport/hair.h"
#include "synth/transport/light_points.h"
#include "synth/transport/lobe.h"
#include "synth/transport/vertex_mix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr float kSmooth = 0.12F;  // roughness below which the lobe changes within a cell
constexpr int kHairProbeNside = 4;

using Bytes = Eigen::Map<const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>>;

void check(const SceneTransport& transport, const Fragments& fragments, const FragmentSurface& surface,
           const CellSet& cells) {
  const Eigen::Index count = fragments.count();
  if (surface.normal.rows() != count || surface.roughness.size() != count || surface.f0.size() != count) {
    throw std::invalid_argument("Each fragment needs a normal, a roughness and an F0.");
  }
  if (transport.diffuse.cols() != cells.count) throw std::invalid_argument("Scene and view must have the same cells.");
  mix_rows(transport, fragments);  // throws
}

// Rows of the microfacet lobe.
class LobeRows {
 public:
  LobeRows(const SceneTransport& transport, const Fragments& fragments, const FragmentSurface& surface,
           const CellSet& cells, const Eigen::Vector3f& camera_position)
      : transport_(transport), fragments_(fragments), surface_(surface), cells_(cells),
        camera_position_(camera_position) {}

  void fill(int i, float* out) const {
    const Eigen::Vector3f view = (camera_position_ - fragments_.position.row(i).transpose()).normalized();
    const Eigen::Vector3f normal = surface_.normal.row(i).transpose();
    const float n_v = normal.dot(view);
    if (n_v <= 0) return;
    Eigen::ArrayXf values;
    if (surface_.roughness(i) < kSmooth) {
      smooth(normal, view, n_v, i, values);
    } else {
      rough(cells_.centre, normal, view, n_v, surface_.roughness(i), surface_.f0(i), values);
    }
    Eigen::ArrayXf share = Eigen::ArrayXf::Zero(cells_.count);
    for (int k = 0; k < 3; ++k) share += fragments_.weights(i, k) * seen(fragments_.vertex(i, k)).cast<float>();
    Eigen::Map<Eigen::ArrayXf>(out, cells_.count) = values * share * (cells_.solid_angle / 255.0F);
  }

 private:
  Bytes seen(int vertex) const {
    const auto row = static_cast<std::size_t>(transport_.row_of_vertex[static_cast<std::size_t>(vertex)]);
    return {transport_.visibility.data() + row * static_cast<std::size_t>(cells_.count), cells_.count};
  }

  template <class Directions>
  static void rough(const Directions& to_light, const Eigen::Vector3f& normal, const Eigen::Vector3f& view, float n_v,
                    float roughness, float f0, Eigen::ArrayXf& out) {
    const Eigen::Index count = to_light.rows();
    const Eigen::ArrayXf n_l = (to_light * normal).array();
    const Eigen::ArrayXf v_l = (to_light * view).array();
    Eigen::ArrayXf n_h(count);
    Eigen::ArrayXf v_h(count);
    out.resize(count);
    lobe_values(n_l, v_l, Eigen::ArrayXf::Constant(count, n_v), Eigen::ArrayXf::Constant(count, roughness),
                Eigen::ArrayXf::Constant(count, f0), n_h, v_h, out);
  }

  // A narrow lobe: its mean over the parts of each cell that it may reach.
  void smooth(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, float n_v, int i, Eigen::ArrayXf& out) const {
    const float roughness = std::max(surface_.roughness(i), kLeastRoughness);
    const float widest = std::cos(std::min(1.5F, 5.0F * roughness + 2.0F * cells_.reach));
    const Eigen::ArrayXf n_l = (cells_.centre * normal).array();
    const Eigen::ArrayXf v_l = (cells_.centre * view).array();
    const Eigen::ArrayXf n_h = (n_l + n_v) / (2.0F + 2.0F * v_l).max(1e-6F).sqrt();
    out.setZero(cells_.count);
    Eigen::ArrayXf values;
    for (int c = 0; c < cells_.count; ++c) {
      if (n_h(c) < widest || n_l(c) < -cells_.reach) continue;
      rough(cells_.parts.middleRows<CellSet::kParts>(CellSet::kParts * c), normal, view, n_v, roughness, surface_.f0(i),
            values);
      out(c) = values.mean();
    }
  }

  const SceneTransport& transport_;
  const Fragments& fragments_;
  const FragmentSurface& surface_;
  const CellSet& cells_;
  Eigen::Vector3f camera_position_;
};

// Rows of strands. What a strand sees is traced in few directions and smoothed between them: hair is never sharp.
class HairRows {
 public:
  HairRows(const Scene& scene, const Fragments& fragments, const FragmentSurface& surface, const CellSet& cells,
           const Eigen::Vector3f& camera_position)
      : points_(hair_points(scene, fragments, surface, camera_position)), cells_(cells), probe_(kHairProbeNside),
        near_cells_(static_cast<std::size_t>(cells.count)) {
    for (int c = 0; c < cells.count; ++c) {
      near_cells_[static_cast<std::size_t>(c)] = probe_.interpolate(cells.centre.row(c).transpose());
    }
  }

  const HairPoints& points() const { return points_; }

  // Shares of the cells seen by every point: #hair x #cells.
  void look(const Scene& scene, int threads) {
    const auto count = static_cast<int>(points_.index.size());
    seen_.resize(count, probe_.cell_count());
    parallel_for(count, threads, [&](int first, int last) {
      std::vector<ShadowRay> rays(static_cast<std::size_t>(probe_.cell_count()));
      for (int i = first; i < last; ++i) {
        if (points_.traced[static_cast<std::size_t>(i)] == 0) continue;
        for (int p = 0; p < probe_.cell_count(); ++p) {
          rays[static_cast<std::size_t>(p)] = {points_.origin.row(i).transpose(), probe_.direction(p), points_.near(i)};
        }
        scene.visible(rays, seen_.row(i).data());
      }
    });
    for (int i = 0; i < count; ++i) {
      if (points_.traced[static_cast<std::size_t>(i)] == 0) seen_.row(i) = seen_.row(traced_beside(i));
    }
  }

  void fill(int i, bool specular, float* out) const {
    Eigen::ArrayXf diffuse;
    Eigen::ArrayXf lobe;
    hair_values(points_.strand[static_cast<std::size_t>(i)], cells_.centre, diffuse, lobe);
    const Eigen::ArrayXf& values = specular ? lobe : diffuse;
    const std::uint8_t* seen = seen_.row(i).data();
    for (int c = 0; c < cells_.count; ++c) {
      const SphereGrid::Interpolation& near = near_cells_[static_cast<std::size_t>(c)];
      float share = 0;
      for (std::size_t k = 0; k < 4; ++k) share += near.weight[k] * static_cast<float>(seen[near.cell[k]]);
      out[c] = share * values(c) * cells_.solid_angle;
    }
  }

 private:
  int traced_beside(int point) const {
    for (int q = points_.first_near[static_cast<std::size_t>(point)];; ++q) {
      assert(q <
             points_.first_near[static_cast<std::size_t>(point) + 1]);  // every one that is not traced has such a neighbour
      const int other = points_.near_point[static_cast<std::size_t>(q)];
      if (points_.traced[static_cast<std::size_t>(other)] != 0) return other;
    }
  }

  HairPoints points_;
  const CellSet& cells_;
  SphereGrid probe_;
  std::vector<SphereGrid::Interpolation> near_cells_;
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> seen_;
};

// Rows that use the same cells: alike in normal, hairs and narrow lobes by themselves.
std::vector<std::vector<int>> groups_of(const Fragments& fragments, const FragmentSurface& surface) {
  Eigen::MatrixXf features(fragments.count(), 4);
  features.leftCols(3) = surface.normal;
  for (int i = 0; i < fragments.count(); ++i) {
    const bool hair = fragments.vertex(i, 0) < 0;
    features(i, 3) = hair ? 8.0F : surface.roughness(i) < kSmooth ? 4.0F : 0.0F;
  }
  return alike_rows(features);
}

}  // namespace

ViewTransport build_view_transport(const Scene& scene, const SceneTransport& transport, Fragments fragments,
                                   FragmentSurface surface, const Eigen::Vector3f& camera_position,
                                   const TransportOptions& options) {
  const CellSet cells(transport.nside);
  check(transport, fragments, surface, cells);
  if (fragments.slope_variance.size() == fragments.count()) {
    // m^2 is twice the variance of the slopes per axis (Beckmann); slopes of facets and of the pixel's normals add up.
    surface.roughness = (surface.roughness.array().square() + 2.0F * fragments.slope_variance.array()).sqrt();
  }
  ViewTransport view;
  HairRows hair(scene, fragments, surface, cells, camera_position);
  hair.look(scene, options.threads);
  view.hair = hair.points().index;
  std::vector<int> hair_row(static_cast<std::size_t>(fragments.count()), -1);
  for (std::size_t h = 0; h < view.hair.size(); ++h)
    hair_row[static_cast<std::size_t>(view.hair[h])] = static_cast<int>(h);

  const LobeRows lobes(transport, fragments, surface, cells, camera_position);
  view.specular =
      pack_rows(fragments.count(), cells.count, groups_of(fragments, surface), options.threads, [&](int i, float* out) {
        const int h = hair_row[static_cast<std::size_t>(i)];
        if (h >= 0) {
          hair.fill(h, true, out);
        } else {
          lobes.fill(i, out);
        }
      });
  const auto hair_count = static_cast<int>(view.hair.size());
  const Eigen::MatrixXf hair_normals = fragments.normal(view.hair, Eigen::all);
  view.hair_diffuse = pack_rows(hair_count, cells.count, alike_rows(hair_normals), options.threads,
                                [&](int h, float* out) { hair.fill(h, false, out); });
  view.camera_position = camera_position;
  view.fragments = std::move(fragments);
  view.surface = std::move(surface);
  return view;
}

}  // namespace faceprobe::synth

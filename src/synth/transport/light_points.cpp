#include "synth/transport/light_points.h"

#include "synth/transport/bounce.h"
#include "synth/transport/lobe.h"

#include <algorithm>

namespace faceprobe::synth {
namespace {

// A flat triangle under smooth normals shades itself where the smooth surface would not. The point is lifted to where the vertices'
// tangent planes put it (Hanika 2021, "Hacking the shadow terminator", Ray Tracing Gems II, chapter 4).
Eigen::Vector3f lifted(const Scene& scene, const Eigen::RowVector3i& vertex, const Eigen::RowVector3f& weights,
                       const Eigen::Vector3f& normal) {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k) point += weights(k) * scene.vertices().row(vertex(k)).transpose();
  Eigen::Vector3f lift = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f n = scene.normals().row(vertex(k)).transpose();
    const float height = (point - scene.vertices().row(vertex(k)).transpose()).dot(n);
    lift -= weights(k) * std::min(0.0F, height) * n;
  }
  return point + lift + kRayOffset * normal;
}

// Light gets past the outermost hairs: without this every second strand would be black in the shadow of the one before it.
constexpr float kHairDepth = 1e-3F;  // metres

void find_neighbours(const Fragments& fragments, HairPoints& hair) {
  const auto key = [&](int point) {
    return fragments.pixel[static_cast<std::size_t>(hair.index[static_cast<std::size_t>(point)])];
  };
  std::vector<int> first(
      static_cast<std::size_t>(fragments.width_px) * static_cast<std::size_t>(fragments.height_px) + 1, 0);
  for (int p = 0; p < hair.count(); ++p) ++first[static_cast<std::size_t>(key(p)) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  hair.first_near.assign(1, 0);
  for (int p = 0; p < hair.count(); ++p) {
    const auto own = static_cast<std::size_t>(hair.index[static_cast<std::size_t>(p)]);
    const int x = key(p) % fragments.width_px;
    const int y = key(p) / fragments.width_px;
    for (int j = std::max(0, y - 1); j <= std::min(fragments.height_px - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(fragments.width_px - 1, x + 1); ++i) {
        const auto pixel = static_cast<std::size_t>(j * fragments.width_px + i);
        for (int q = first[pixel]; q < first[pixel + 1]; ++q) {
          const auto other = static_cast<std::size_t>(hair.index[static_cast<std::size_t>(q)]);
          const bool same =
              fragments.figure[own] == fragments.figure[other] && fragments.part[own] == fragments.part[other];
          if (same) hair.near_point.push_back(q);
        }
      }
    }
    hair.first_near.push_back(static_cast<int>(hair.near_point.size()));
  }
  hair.traced.resize(static_cast<std::size_t>(hair.count()));
  for (int p = 0; p < hair.count(); ++p) {
    const auto begin = hair.near_point.begin() + hair.first_near[static_cast<std::size_t>(p)];
    const auto end = hair.near_point.begin() + hair.first_near[static_cast<std::size_t>(p) + 1];
    const bool alone = std::none_of(begin, end, [](int other) { return other % 2 == 0; });
    hair.traced[static_cast<std::size_t>(p)] = p % 2 == 0 || alone ? 1 : 0;
  }
}

}  // namespace

SurfacePoints fragment_points(const Scene& scene, const SceneTransport& transport, const ViewTransport& view) {
  const Fragments& fragments = view.fragments;
  SurfacePoints out;
  for (int i = 0; i < fragments.count(); ++i) {
    if (fragments.vertex(i, 0) >= 0) out.index.push_back(i);
  }
  out.origin.resize(out.count(), 3);
  out.normal = fragments.normal(out.index, Eigen::all);
  out.lobe_normal = view.surface.normal(out.index, Eigen::all);
  out.roughness = view.surface.roughness(out.index).array().max(kLeastRoughness);
  out.f0 = view.surface.f0(out.index).array();
  out.view.resize(out.count(), 3);
  for (int p = 0; p < out.count(); ++p) {
    const int i = out.index[static_cast<std::size_t>(p)];
    out.origin.row(p) =
        lifted(scene, fragments.vertex.row(i), fragments.weights.row(i), fragments.normal.row(i).transpose()).transpose();
    out.view.row(p) = (view.camera_position.transpose() - fragments.position.row(i)).normalized();
  }
  out.row.resize(out.count(), 3);
  out.pixel_m.resize(out.count());
  for (int p = 0; p < out.count(); ++p) {
    const int i = out.index[static_cast<std::size_t>(p)];
    for (int k = 0; k < 3; ++k) {
      out.row(p, k) = transport.row_of_vertex[static_cast<std::size_t>(fragments.vertex(i, k))];
    }
    out.pixel_m(p) = fragments.pixel_rad * (view.camera_position.transpose() - fragments.position.row(i)).norm();
  }
  out.n_v = out.lobe_normal.cwiseProduct(out.view).rowwise().sum().array();
  return out;
}

SurfacePoints vertex_points(const Scene& scene, const SceneTransport& transport) {
  SurfacePoints out;
  std::vector<int> vertices(static_cast<std::size_t>(transport.diffuse.rows()));
  for (std::size_t v = 0; v < transport.row_of_vertex.size(); ++v) {
    const int row = transport.row_of_vertex[v];
    if (row >= 0) vertices[static_cast<std::size_t>(row)] = static_cast<int>(v);
  }
  for (std::size_t row = 0; row < vertices.size(); ++row) out.index.push_back(static_cast<int>(row));
  out.normal = scene.normals()(vertices, Eigen::all);
  out.origin = scene.vertices()(vertices, Eigen::all) + kRayOffset * out.normal;
  return out;
}

HairPoints hair_points(const Scene& scene, const Fragments& fragments, const FragmentSurface& surface,
                       const Eigen::Vector3f& camera_position) {
  HairPoints out;
  for (int i = 0; i < fragments.count(); ++i) {
    if (fragments.vertex(i, 0) < 0) out.index.push_back(i);
  }
  out.origin = fragments.position(out.index, Eigen::all);
  out.near.resize(out.count());
  std::vector<std::vector<float>> radius;
  for (const Figure& figure : scene.figures()) {
    radius.emplace_back();
    for (const Strands& strands : figure.strands) {
      radius.back().push_back(strands.points.rows() > 0 ? strands.points.col(3).maxCoeff() : 0.0F);
    }
  }
  for (int p = 0; p < out.count(); ++p) {
    const auto i = static_cast<std::size_t>(out.index[static_cast<std::size_t>(p)]);
    const auto row = static_cast<Eigen::Index>(i);
    out.near(p) = kHairDepth + 2.0F * radius[fragments.figure[i]][fragments.part[i]];
    const Eigen::Vector3f view = (camera_position - fragments.position.row(row).transpose()).normalized();
    out.strand.push_back(
        make_strand(fragments.tangent.row(row).transpose(), view, surface.roughness(row), surface.f0(row)));
  }
  find_neighbours(fragments, out);
  return out;
}

}  // namespace faceprobe::synth

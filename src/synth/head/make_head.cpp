#include "faceprobe/synth/head_model.h"

#include "faceprobe/core/vertex_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace faceprobe::synth {
namespace {

void add_modes(const std::vector<Eigen::MatrixX3f>& modes, const Eigen::VectorXf& weights, Eigen::MatrixX3f& vertices) {
  if (weights.size() > static_cast<Eigen::Index>(modes.size())) {
    throw std::invalid_argument("A head was asked for with more weights than its model has modes.");
  }
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const Eigen::MatrixX3f& mode = modes[static_cast<std::size_t>(i)];
    if (weights(i) != 0) vertices.topRows(mode.rows()) += weights(i) * mode;
  }
}

constexpr float kSameSide = 0.2F;  // cosine: what faces farther apart than this are two surfaces

// Vertices at one place are one point of the surface that a file has split, at a seam of its texture or between its parts: without
// this the shading would show a crease there. Surfaces that merely touch, such as closed lips, face each other and stay apart.
Eigen::MatrixX3f whole_normals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles) {
  std::vector<int> order(static_cast<std::size_t>(vertices.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) { return std::array<float, 3>{vertices(v, 0), vertices(v, 1), vertices(v, 2)}; };
  std::ranges::sort(order, [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });

  const Eigen::MatrixX3f weighted = area_normals(vertices, triangles);
  Eigen::MatrixX3f normals = weighted;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && key(order[last]) == key(order[first])) ++last;
    for (std::size_t i = first; i < last; ++i) {
      const auto own = weighted.row(order[i]);
      for (std::size_t j = first; j < last; ++j) {
        const auto other = weighted.row(order[j]);
        if (i != j && own.dot(other) > kSameSide * own.norm() * other.norm()) normals.row(order[i]) += other;
      }
    }
  }
  return unit_normals(normals);
}

// How the parts other than skin look: moist, the teeth smoother than the gums. rho_s = .25 is a lobe that keeps its energy.
Reflectance part_reflectance(Material material) {
  switch (material) {
    case Material::kEye: return {{0.62F, 0.53F, 0.48F}, 0.08F, 0.25F, 0.025F};
    case Material::kMouth: return {{0.22F, 0.07F, 0.06F}, 0.25F, 0.20F, 0.025F};
    case Material::kTeeth: return {{0.55F, 0.50F, 0.40F}, 0.15F, 0.25F, 0.040F};
    default: return {};
  }
}

// Rows that some triangle uses, in rising order, and the triangles renumbered to them.
struct Compacted {
  std::vector<int> rows;
  Eigen::MatrixX3i triangles;
};
Compacted compact(const Eigen::MatrixX3i& source, const std::vector<int>& chosen, Eigen::Index row_count) {
  Compacted result{{}, Eigen::MatrixX3i(static_cast<Eigen::Index>(chosen.size()), 3)};
  std::vector<int> number(static_cast<std::size_t>(row_count), -1);
  for (const int t : chosen) {
    for (int corner = 0; corner < 3; ++corner) number[static_cast<std::size_t>(source(t, corner))] = 0;
  }
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(result.rows.size());
    result.rows.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      result.triangles(static_cast<Eigen::Index>(i), corner) =
          number[static_cast<std::size_t>(source(chosen[i], corner))];
    }
  }
  return result;
}

struct Deformed {
  Eigen::MatrixX3f vertices, normals, albedo;
};

SurfaceMesh part(const HeadModel& model, const Deformed& deformed, Material material) {
  std::vector<int> chosen;
  for (std::size_t t = 0; t < model.triangle_material.size(); ++t) {
    if (model.triangle_material[t] == material) chosen.push_back(static_cast<int>(t));
  }
  SurfaceMesh mesh;
  mesh.material = material;
  mesh.reflectance = part_reflectance(material);
  if (chosen.empty()) return mesh;
  Compacted corners = compact(model.triangles, chosen, model.neutral.rows());
  mesh.triangles = std::move(corners.triangles);
  mesh.vertices = deformed.vertices(corners.rows, Eigen::all);
  mesh.normals = deformed.normals(corners.rows, Eigen::all);
  for (const int v : corners.rows) mesh.vertex_region.push_back(model.vertex_region[static_cast<std::size_t>(v)]);
  if (deformed.albedo.rows() > 0 && material == Material::kSkin)
    mesh.vertex_albedo = deformed.albedo(corners.rows, Eigen::all);
  if (model.uv.rows() > 0) {
    Compacted texture = compact(model.triangle_uv, chosen, model.uv.rows());
    mesh.triangle_uv = std::move(texture.triangles);
    mesh.uv = model.uv(texture.rows, Eigen::all);
  }
  return mesh;
}

Eigen::MatrixX3f dense_points(const HeadModel& model, const Eigen::MatrixX3f& vertices) {
  Eigen::MatrixX3f points(static_cast<Eigen::Index>(model.dense_landmarks.size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const SurfacePoint& point = model.dense_landmarks[static_cast<std::size_t>(i)];
    points.row(i).setZero();
    for (int corner = 0; corner < 3; ++corner) {
      points.row(i) += point.weights(corner) * vertices.row(model.triangles(point.triangle, corner));
    }
  }
  return points;
}

}  // namespace

Head make_head(const HeadModel& model, const HeadParameters& parameters) {
  Deformed deformed{model.neutral, {}, model.vertex_albedo};
  add_modes(model.identity, parameters.identity, deformed.vertices);
  add_modes(model.expression, parameters.expression, deformed.vertices);
  if (deformed.albedo.rows() > 0) {
    add_modes(model.albedo_modes, parameters.albedo, deformed.albedo);
    deformed.albedo =
        deformed.albedo.cwiseMax(0.0F).cwiseMin(1.0F);  // a linear model does not know that albedo ends there
  }
  deformed.normals = whole_normals(deformed.vertices, model.triangles);

  Head head;
  for (const Material material : {Material::kSkin, Material::kEye, Material::kMouth, Material::kTeeth}) {
    SurfaceMesh mesh = part(model, deformed, material);
    if (mesh.triangles.rows() > 0) head.figure.meshes.push_back(std::move(mesh));
  }
  if (!model.landmarks.empty()) head.landmarks = deformed.vertices(model.landmarks, Eigen::all);
  head.dense_landmarks = dense_points(model, deformed.vertices);
  return head;
}

}  // namespace faceprobe::synth

#include "synth/wardrobe/shapes.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/vertex_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

Eigen::Vector3f unit(const Eigen::Vector3f& v, const Eigen::Vector3f& otherwise) {
  const float length = v.norm();
  return length > 1e-9F ? Eigen::Vector3f(v / length) : otherwise;
}

float signed_power(float x, float exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }

}  // namespace

void MeshBuilder::grid(const std::vector<Eigen::Vector3f>& points, int columns, bool around, bool turned) {
  const int first = vertex_count();
  const int rows = static_cast<int>(points.size()) / columns;
  points_.insert(points_.end(), points.begin(), points.end());
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + (around ? 0 : 1) < columns; ++c) {
      const int next = (c + 1) % columns;
      int a = first + r * columns + c;
      int b = first + r * columns + next;
      if (turned) std::swap(a, b);
      triangles_.emplace_back(a, b, b + columns);
      triangles_.emplace_back(a, b + columns, a + columns);
    }
  }
}

void MeshBuilder::tube(std::span<const Eigen::Vector3f> path, float radius, int sides, bool ring) {
  const std::vector<float> radii(path.size(), radius);
  tube(path, radii, sides, ring);
}

void MeshBuilder::tube(std::span<const Eigen::Vector3f> path, std::span<const float> radii, int sides, bool ring) {
  const auto n = static_cast<int>(path.size());
  std::vector<Eigen::Vector3f> points;
  Eigen::Vector3f side(0, 0, 0);
  const auto at = [&](int i) { return path[static_cast<std::size_t>(ring ? (i + n) % n : std::clamp(i, 0, n - 1))]; };
  const auto circle = [&](const Eigen::Vector3f& centre, const Eigen::Vector3f& axis, float radius) {
    side -= axis * axis.dot(side);
    side = unit(side, axis.unitOrthogonal());
    const Eigen::Vector3f other = axis.cross(side);
    for (int k = 0; k < sides; ++k) {
      const float angle = kTurn * static_cast<float>(k) / static_cast<float>(sides);
      points.emplace_back(centre + radius * (std::cos(angle) * side + std::sin(angle) * other));
    }
  };
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3f axis = unit(at(i + 1) - at(i - 1), Eigen::Vector3f(0, 0, 1));
    const float radius = radii[static_cast<std::size_t>(i)];
    if (!ring && i == 0) {  // a round end in two steps
      circle(at(0) - 0.98F * radius * axis, axis, 0.05F * radius);
      circle(at(0) - 0.6F * radius * axis, axis, 0.8F * radius);
    }
    circle(at(i), axis, radius);
    if (!ring && i == n - 1) {
      circle(at(i) + 0.6F * radius * axis, axis, 0.8F * radius);
      circle(at(i) + 0.98F * radius * axis, axis, 0.05F * radius);
    }
  }
  if (ring) {
    // The frame has turned on its way round; the last row is the first again, at the nearest turn.
    const std::size_t last = points.size() - static_cast<std::size_t>(sides);
    int best = 0;
    for (int k = 1; k < sides; ++k) {
      if ((points[static_cast<std::size_t>(k)] - points[last]).norm() <
          (points[static_cast<std::size_t>(best)] - points[last]).norm())
        best = k;
    }
    for (int k = 0; k < sides; ++k) points.push_back(points[static_cast<std::size_t>((best + k) % sides)]);
  }
  grid(points, sides, true);
}

void MeshBuilder::ellipsoid(const Eigen::Vector3f& centre, const Eigen::Matrix3f& axes, int rings, int sides) {
  std::vector<Eigen::Vector3f> points;
  for (int r = 0; r <= rings; ++r) {
    const float polar =
        std::clamp(kTurn / 2 * static_cast<float>(r) / static_cast<float>(rings), 0.02F, kTurn / 2 - 0.02F);
    for (int k = 0; k < sides; ++k) {
      const float angle = kTurn * static_cast<float>(k) / static_cast<float>(sides);
      points.emplace_back(centre + axes * Eigen::Vector3f(std::sin(polar) * std::sin(angle), -std::cos(polar),
                                                          std::sin(polar) * std::cos(angle)));
    }
  }
  grid(points, sides, true);
}

void MeshBuilder::rounded_box(const Eigen::Vector3f& centre, const Eigen::Matrix3f& axes, float sharpness, int steps) {
  std::vector<Eigen::Vector3f> points;
  const int sides = 4 * steps;
  const float exponent = 2.0F / sharpness;
  for (int r = 0; r <= 2 * steps; ++r) {
    const float polar =
        std::clamp(kTurn / 2 * static_cast<float>(r) / static_cast<float>(2 * steps), 1e-4F, kTurn / 2 - 1e-4F);
    const float ring = std::pow(std::sin(polar), exponent);
    for (int k = 0; k < sides; ++k) {
      const float angle = kTurn * static_cast<float>(k) / static_cast<float>(sides);
      points.emplace_back(centre + axes * Eigen::Vector3f(ring * signed_power(std::sin(angle), exponent),
                                                          -signed_power(std::cos(polar), exponent),
                                                          ring * signed_power(std::cos(angle), exponent)));
    }
  }
  grid(points, sides, true);
}

void MeshBuilder::disc(std::span<const Eigen::Vector3f> outline, const Eigen::Vector3f& bulge) {
  Eigen::Vector3f middle(0, 0, 0);
  for (const Eigen::Vector3f& p : outline) middle += p;
  middle /= static_cast<float>(outline.size());
  // Three rings towards the middle follow a paraboloid.
  constexpr std::array<float, 3> kShares = {1.0F, 0.66F, 0.33F};
  const int first = vertex_count();
  const auto n = static_cast<int>(outline.size());
  for (const float share : kShares) {
    for (const Eigen::Vector3f& p : outline)
      points_.emplace_back(middle + share * (p - middle) + (1.0F - share * share) * bulge);
  }
  points_.emplace_back(middle + bulge);
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    for (int ring = 0; ring < 2; ++ring) {
      const int a = first + ring * n + k;
      const int b = first + ring * n + next;
      triangles_.emplace_back(a, b, b + n);
      triangles_.emplace_back(a, b + n, a + n);
    }
    triangles_.emplace_back(first + 2 * n + k, first + 2 * n + next, first + 3 * n);
  }
}

void MeshBuilder::colour(const std::function<Eigen::Vector3f(const Eigen::Vector3f&)>& albedo_at, int first_vertex) {
  albedo_.resize(points_.size(), Eigen::Vector3f::Constant(0.5F));
  for (auto i = static_cast<std::size_t>(first_vertex); i < points_.size(); ++i) {
    albedo_[i] = albedo_at(points_[i]).cwiseMax(0.004F).cwiseMin(0.9F);
  }
}

SurfaceMesh MeshBuilder::take(Material material, Region region, const Reflectance& reflectance) {
  SurfaceMesh mesh;
  mesh.material = material;
  mesh.reflectance = reflectance;
  mesh.vertices.resize(vertex_count(), 3);
  for (std::size_t i = 0; i < points_.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = points_[i].transpose();
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles_[i].transpose();
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  mesh.vertex_region.assign(points_.size(), region);
  if (!albedo_.empty()) {
    albedo_.resize(points_.size(), reflectance.albedo);
    mesh.vertex_albedo.resize(vertex_count(), 3);
    for (std::size_t i = 0; i < albedo_.size(); ++i)
      mesh.vertex_albedo.row(static_cast<Eigen::Index>(i)) = albedo_[i].transpose();
  }
  points_.clear();
  albedo_.clear();
  triangles_.clear();
  return mesh;
}

std::vector<Eigen::Vector3f> smooth_path(std::span<const Eigen::Vector3f> knots, int per_span, bool ring) {
  const auto n = static_cast<int>(knots.size());
  const auto at = [&](int i) { return knots[static_cast<std::size_t>(ring ? (i + n) % n : std::clamp(i, 0, n - 1))]; };
  std::vector<Eigen::Vector3f> path;
  for (int i = 0; i < (ring ? n : n - 1); ++i) {
    for (int k = 0; k < per_span; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(per_span);
      const Eigen::Vector3f a = at(i - 1);
      const Eigen::Vector3f b = at(i);
      const Eigen::Vector3f c = at(i + 1);
      const Eigen::Vector3f d = at(i + 2);
      path.emplace_back(0.5F * (2.0F * b + t * (c - a) + t * t * (2.0F * a - 5.0F * b + 4.0F * c - d) +
                                t * t * t * (3.0F * (b - c) + d - a)));
    }
  }
  if (!ring) path.push_back(knots.back());
  return path;
}

}  // namespace faceprobe::synth

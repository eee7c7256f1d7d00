#include "loft.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/vertex_normals.h"

#include <cmath>
#include <cstddef>

namespace faceprobe::render {
namespace {

constexpr float kPiF = static_cast<float>(kPi);

bool is_point(const Ring& ring) { return ring.a.isZero(0) && ring.b.isZero(0); }

bool same(const Ring& one, const Ring& two) { return one.centre == two.centre && one.a == two.a && one.b == two.b; }

Eigen::Vector3f ring_point(const Ring& ring, int column, int columns) {
  const float phi = 2 * kPiF * static_cast<float>(column) / static_cast<float>(columns);
  return ring.centre + std::cos(phi) * ring.a + std::sin(phi) * ring.b;
}

// Between two rings whose vertices begin at `low` and `high`; a point has one vertex, a ring one per column.
void add_strip(std::vector<Eigen::Vector3i>& triangles, int low, bool low_is_point, int high, bool high_is_point,
               int columns) {
  for (int j = 0; j < columns; ++j) {
    const int next = (j + 1) % columns;
    if (low_is_point) {
      triangles.emplace_back(low, high + next, high + j);
    } else if (high_is_point) {
      triangles.emplace_back(low + j, low + next, high);
    } else {
      triangles.emplace_back(low + j, low + next, high + next);
      triangles.emplace_back(low + j, high + next, high + j);
    }
  }
}

}  // namespace

TriangleMesh loft(const std::vector<Ring>& rings, int columns) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  int before = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const bool point = is_point(rings[i]);
    const auto begin = static_cast<int>(vertices.size());
    for (int j = 0; j < (point ? 1 : columns); ++j) vertices.push_back(ring_point(rings[i], j, columns));
    if (i > 0 && !same(rings[i - 1], rings[i])) {
      add_strip(triangles, before, is_point(rings[i - 1]), begin, point, columns);
    }
    before = begin;
  }
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v) mesh.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v];
  for (std::size_t t = 0; t < triangles.size(); ++t) mesh.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  mesh.normals = vertex_normals<double>(mesh.vertices, mesh.triangles);
  return mesh;
}

Profile& Profile::curve(const Eigen::Vector2f& b, const Eigen::Vector2f& c, const Eigen::Vector2f& end, int steps) {
  const Bezier<2> piece{end_, b, c, end};
  const auto point_at = [&](float t) {
    const Eigen::Vector2f along = piece.tangent(t);
    return ProfilePoint{piece.at(t), {along.y(), -along.x()}};
  };
  const ProfilePoint first = point_at(0);
  // Beyond about five degrees it is meant as an edge.
  const bool edge = points_.empty() || points_.back().normal.dot(first.normal) < 0.996F;
  if (edge) points_.push_back(first);
  for (int i = 1; i < steps; ++i) points_.push_back(point_at(static_cast<float>(i) / static_cast<float>(steps)));
  points_.push_back(point_at(1));
  points_.back().at = end;  // to the bit, for the next piece and for the axis
  end_ = end;
  return *this;
}

Profile& Profile::line(const Eigen::Vector2f& end) {
  const Eigen::Vector2f third = (end - end_) / 3;
  return curve(end_ + third, end - third, end, 1);
}

Profile& Profile::bend(const Eigen::Vector2f& corner, const Eigen::Vector2f& end, int steps) {
  constexpr float kQuarter = 0.5523F;  // of the way to the corner: the cubic that is nearest to a quarter circle
  return curve(end_ + kQuarter * (corner - end_), end + kQuarter * (corner - end), end, steps);
}

TriangleMesh lathe(const std::vector<ProfilePoint>& profile, int columns) {
  std::vector<Ring> rings;
  rings.reserve(profile.size());
  for (const ProfilePoint& p : profile) rings.push_back({{0, p.at.y(), 0}, {0, 0, p.at.x()}, {p.at.x(), 0, 0}});
  TriangleMesh mesh = loft(rings, columns);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (is_point(rings[i])) {
      mesh.normals.row(row++) = Eigen::RowVector3f(0, profile[i].normal.y() < 0 ? -1.0F : 1.0F, 0);
      continue;
    }
    const Eigen::Vector2f& n = profile[i].normal;
    const Ring turned{{0, n.y(), 0}, {0, 0, n.x()}, {n.x(), 0, 0}};
    for (int j = 0; j < columns; ++j) mesh.normals.row(row++) = ring_point(turned, j, columns).normalized();
  }
  return mesh;
}

TriangleMesh ball(float radius, int steps) {
  std::vector<ProfilePoint> outline;
  for (int i = 0; i <= steps; ++i) {
    const float theta = kPiF * static_cast<float>(i) / static_cast<float>(steps);
    const bool pole = i == 0 || i == steps;
    const Eigen::Vector2f normal(pole ? 0.0F : std::sin(theta), -std::cos(theta));
    outline.push_back({radius * normal, normal});
  }
  return lathe(outline, 2 * steps);
}

TriangleMesh tube(const Bezier<3>& curve, float radius, const Eigen::Vector3f& side, int steps, int columns) {
  std::vector<Ring> rings;
  const auto add = [&](float t, float width, float beyond) {
    const Eigen::Vector3f along = curve.tangent(t);
    rings.push_back({curve.at(t) + beyond * along, width * side.cross(along), width * side});
  };
  constexpr int kCap = 6;
  for (int i = 0; i < kCap; ++i) {
    const float angle = 0.5F * kPiF * static_cast<float>(i) / kCap;
    add(0, radius * std::sin(angle), -radius * std::cos(angle));
  }
  for (int i = 0; i <= steps; ++i) add(static_cast<float>(i) / static_cast<float>(steps), radius, 0);
  for (int i = kCap - 1; i >= 0; --i) {
    const float angle = 0.5F * kPiF * static_cast<float>(i) / kCap;
    add(1, radius * std::sin(angle), radius * std::cos(angle));
  }
  return loft(rings, columns);
}

}  // namespace faceprobe::render

#include "face/raster.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::face {
namespace {

// Twice the area of (a, b, p), positive when p is to the left of a -> b on a screen with y down.
double edge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (b.x() - a.x()) * (a.y() - p.y()) - (a.x() - p.x()) * (b.y() - a.y());
}

// First and last + 1 pixel whose centre lies in [low, high], clipped to [0, size).
std::pair<int, int> pixel_range(double low, double high, int size) {
  const double first = std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(size));
  const double last = std::clamp(std::floor(high - 0.5) + 1.0, 0.0, static_cast<double>(size));
  return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

std::vector<Fragment> rasterize_triangles(const Eigen::MatrixX2d& points_px, const Eigen::VectorXd& depths,
                                          const Eigen::MatrixX3i& triangles, int width, int height) {
  std::vector<Fragment> fragments(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<double> nearest(fragments.size(), 0);  // inverse depth
  for (int t = 0; t < triangles.rows(); ++t) {
    Eigen::Matrix<double, 2, 3> corner;
    Eigen::Vector3d inverse_depth;
    bool usable = true;
    for (int k = 0; k < 3; ++k) {
      corner.col(k) = points_px.row(triangles(t, k)).transpose();
      const double depth = depths(triangles(t, k));
      usable = usable && depth > 0 && corner.col(k).allFinite();
      inverse_depth(k) = 1.0 / depth;
    }
    const double area = edge(corner.col(0), corner.col(1), corner.col(2));
    if (!usable || !(area > 0)) continue;
    const auto [x_first, x_last] = pixel_range(corner.row(0).minCoeff(), corner.row(0).maxCoeff(), width);
    const auto [y_first, y_last] = pixel_range(corner.row(1).minCoeff(), corner.row(1).maxCoeff(), height);
    for (int y = y_first; y < y_last; ++y) {
      for (int x = x_first; x < x_last; ++x) {
        const Eigen::Vector2d centre(x + 0.5, y + 0.5);
        const Eigen::Vector3d on_screen =
            Eigen::Vector3d(edge(corner.col(1), corner.col(2), centre), edge(corner.col(2), corner.col(0), centre),
                            edge(corner.col(0), corner.col(1), centre)) /
            area;
        if (on_screen.minCoeff() < 0) continue;
        // 1/z is linear on the screen; so is any surface value over z.
        const Eigen::Vector3d over_depth = on_screen.cwiseProduct(inverse_depth);
        const double here = over_depth.sum();
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        if (here <= nearest[at]) continue;
        nearest[at] = here;
        fragments[at] = {t, (over_depth / here).cast<float>()};
      }
    }
  }
  return fragments;
}

Eigen::MatrixX3f vertex_normals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles) {
  Eigen::MatrixX3f normals = Eigen::MatrixX3f::Zero(vertices.rows(), 3);
  for (const auto& triangle : triangles.rowwise()) {
    const auto at = [&](int k) -> Eigen::Vector3f { return vertices.row(triangle(k % 3)).transpose(); };
    const Eigen::Vector3f normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f a = at(k + 1) - at(k);
      const Eigen::Vector3f b = at(k + 2) - at(k);
      normals.row(triangle(k)) += std::atan2(a.cross(b).norm(), a.dot(b)) * normal.transpose();
    }
  }
  normals.rowwise().normalize();
  return normals;
}

}  // namespace faceprobe::face

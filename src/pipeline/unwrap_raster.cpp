#include "pipeline/unwrap_raster.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {

bool plane_weights(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c,
                   const Eigen::Vector2f& point, Eigen::Vector3f& weights) {
  const Eigen::Vector2f ab = b - a;
  const Eigen::Vector2f ac = c - a;
  const Eigen::Vector2f ap = point - a;
  const float area = ab.x() * ac.y() - ac.x() * ab.y();
  if (area == 0.0F) return false;
  const float wb = (ap.x() * ac.y() - ac.x() * ap.y()) / area;
  const float wc = (ab.x() * ap.y() - ap.x() * ab.y()) / area;
  weights = {1.0F - wb - wc, wb, wc};
  return true;
}

MeshRaster raster_mesh(const Eigen::MatrixX3f& points, const Eigen::MatrixX3i& triangles,
                       const std::vector<int>& chosen, int width, int height) {
  // Edges belong to both neighbours, so that rounding leaves no holes between them.
  constexpr float kEdge = -1e-5F;
  MeshRaster out{width, height,
                 std::vector<RasterCell>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (const int t : chosen) {
    const Eigen::Matrix3f corner = points(triangles.row(t), Eigen::all);
    if (!corner.allFinite()) continue;
    const Eigen::Vector2f a = corner.row(0).head<2>().transpose();
    const Eigen::Vector2f b = corner.row(1).head<2>().transpose();
    const Eigen::Vector2f c = corner.row(2).head<2>().transpose();
    const Eigen::Vector2f low = a.cwiseMin(b).cwiseMin(c);
    const Eigen::Vector2f high = a.cwiseMax(b).cwiseMax(c);
    const int x0 = static_cast<int>(std::floor(std::clamp(low.x(), 0.0F, static_cast<float>(width))));
    const int y0 = static_cast<int>(std::floor(std::clamp(low.y(), 0.0F, static_cast<float>(height))));
    const int x1 = static_cast<int>(std::ceil(std::clamp(high.x(), 0.0F, static_cast<float>(width))));
    const int y1 = static_cast<int>(std::ceil(std::clamp(high.y(), 0.0F, static_cast<float>(height))));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        Eigen::Vector3f weights;
        if (!plane_weights(a, b, c, {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F}, weights)) break;
        if (weights.minCoeff() < kEdge) continue;
        const float depth = weights.dot(corner.col(2));
        RasterCell& cell =
            out.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
        if (cell.triangle < 0 || depth < cell.depth) cell = {t, weights, depth};
      }
    }
  }
  return out;
}

}  // namespace faceprobe::pipeline

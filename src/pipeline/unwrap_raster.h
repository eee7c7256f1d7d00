#pragma once
// Triangles drawn into a picture of numbers: which triangle covers a pixel's centre, and where in it.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace faceprobe::pipeline {

struct RasterCell {
  int triangle = -1;                                  // -1: none
  Eigen::Vector3f weights = Eigen::Vector3f::Zero();  // in the picture's plane, sum 1
  float depth = 0;
};

struct MeshRaster {
  int width = 0;
  int height = 0;
  std::vector<RasterCell> cells;

  const RasterCell& at(int x, int y) const {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

// `points`: pixel coordinates and depth of vertices; the least depth wins, of equal ones the first triangle. `chosen` triangles only
// (rows of `triangles`).
MeshRaster raster_mesh(const Eigen::MatrixX3f& points, const Eigen::MatrixX3i& triangles,
                       const std::vector<int>& chosen, int width, int height);

// Barycentric weights of a point in a triangle of the plane; false where the triangle has no area.
bool plane_weights(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c,
                   const Eigen::Vector2f& point, Eigen::Vector3f& weights);

}  // namespace faceprobe::pipeline

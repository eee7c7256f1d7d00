#pragma once
// Triangles to pixels: the nearest front face under each pixel centre, with perspective-correct weights.

#include <Eigen/Core>
#include <vector>

namespace faceprobe::face {

struct Fragment {
  int triangle = -1;
  Eigen::Vector3f weights = Eigen::Vector3f::Zero();  // of the triangle's three vertices on the surface, sum 1
};

// `points_px` are the vertices' pixels, `depths` their positive distances along the optical axis. Triangles that run
// counter-clockwise as seen (y up) are front faces; the others, and those with a vertex at depth <= 0, are left out.
// One fragment per pixel, row-major; triangle = -1 where nothing is.
std::vector<Fragment> rasterize_triangles(const Eigen::MatrixX2d& points_px, const Eigen::VectorXd& depths,
                                          const Eigen::MatrixX3i& triangles, int width, int height);

// #vertices x 3 unit normals: the triangles' normals averaged by the angle they have at the vertex (Thuermer &
// Wuethrich 1998).
Eigen::MatrixX3f vertex_normals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles);

}  // namespace faceprobe::face

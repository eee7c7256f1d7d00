#pragma once
// Normals at the vertices of a triangle mesh, where each triangle weighs as much as its area.
//
//   const Eigen::MatrixX3f normals = vertex_normals(vertices, triangles);
//
// `Scalar` is that of the sums. Float does for heads in metres; models of unknown size may have triangles whose squared area is no float.

#include <Eigen/Geometry>

namespace faceprobe {

// #V x 3: the sums of the normals of each vertex's triangles times twice their areas; 0 for vertices of no triangle.
template <class Scalar = float>
Eigen::Matrix<Scalar, Eigen::Dynamic, 3> area_normals(const Eigen::MatrixX3f& vertices,
                                                      const Eigen::MatrixX3i& triangles) {
  using Row = Eigen::RowVector3<Scalar>;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 3> sums = Eigen::Matrix<Scalar, Eigen::Dynamic, 3>::Zero(vertices.rows(), 3);
  for (const auto& corners : triangles.rowwise()) {
    const Row a = vertices.row(corners(0)).template cast<Scalar>();
    const Row ab = vertices.row(corners(1)).template cast<Scalar>() - a;
    const Row ac = vertices.row(corners(2)).template cast<Scalar>() - a;
    const Row twice_area = ab.cross(ac);
    for (int k = 0; k < 3; ++k) sums.row(corners(k)) += twice_area;
  }
  return sums;
}

// Each row at unit length; +z where it is 0.
template <class Scalar>
Eigen::MatrixX3f unit_normals(const Eigen::Matrix<Scalar, Eigen::Dynamic, 3>& sums) {
  Eigen::MatrixX3f normals(sums.rows(), 3);
  for (Eigen::Index v = 0; v < sums.rows(); ++v) {
    const Scalar length = sums.row(v).norm();
    if (length > 0) {
      normals.row(v) = (sums.row(v) / length).template cast<float>();
    } else {
      normals.row(v) = Eigen::RowVector3f::UnitZ();
    }
  }
  return normals;
}

// #V x 3, unit length; vertices of no triangle get +z. `triangles` are #T x 3, counter-clockwise seen from outside.
template <class Scalar = float>
Eigen::MatrixX3f vertex_normals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles) {
  return unit_normals(area_normals<Scalar>(vertices, triangles));
}

}  // namespace faceprobe

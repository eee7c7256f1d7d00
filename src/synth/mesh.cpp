#include "faceprobe/synth/mesh.h"

#include <Eigen/Geometry>

namespace faceprobe::synth {

Eigen::MatrixX3f vertex_normals(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles) {
  Eigen::MatrixX3f normals = Eigen::MatrixX3f::Zero(vertices.rows(), 3);
  for (const auto& t : triangles.rowwise()) {
    const Eigen::Vector3f a = vertices.row(t(0)).transpose();
    const Eigen::Vector3f b = vertices.row(t(1)).transpose();
    const Eigen::Vector3f c = vertices.row(t(2)).transpose();
    const Eigen::RowVector3f twice_area = (b - a).cross(c - a).transpose();
    for (int corner = 0; corner < 3; ++corner) normals.row(t(corner)) += twice_area;
  }
  for (auto normal : normals.rowwise()) {
    const float length = normal.norm();
    if (length > 0) {
      normal /= length;
    } else {
      normal = Eigen::RowVector3f(0, 0, 1);
    }
  }
  return normals;
}

}  // namespace faceprobe::synth

#include "faceprobe/synth/person.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace faceprobe::synth {
namespace {

// Least squares on |p|^2 = 2 c.p + (r^2 - |c|^2). The cornea's bulge is a few hundredths of the surface and moves c by little.
Eyeball fit_sphere(const Eigen::MatrixX3f& points) {
  const Eigen::RowVector3f mean = points.colwise().mean();  // centred: the equations stay well conditioned
  const Eigen::MatrixX3f p = points.rowwise() - mean;
  Eigen::Matrix4f normal_matrix = Eigen::Matrix4f::Zero();
  Eigen::Vector4f right = Eigen::Vector4f::Zero();
  for (const auto& row : p.rowwise()) {
    const Eigen::Vector4f a(2.0F * row(0), 2.0F * row(1), 2.0F * row(2), 1.0F);
    normal_matrix += a * a.transpose();
    right += a * row.squaredNorm();
  }
  const Eigen::Vector4f x = normal_matrix.ldlt().solve(right);
  Eyeball eye;
  eye.centre = x.head<3>() + mean.transpose();
  eye.radius_m = std::sqrt(std::max(1e-8F, x(3) + x.head<3>().squaredNorm()));
  return eye;
}

constexpr double kCorneaShare = 0.05;  // of the vertices: those farthest from the centre

Eigen::Vector3f farthest_bulge(const Eigen::MatrixX3f& points, const Eyeball& eye) {
  const Eigen::MatrixX3f from_centre = points.rowwise() - eye.centre.transpose();
  const Eigen::VectorXf distance = from_centre.rowwise().norm();
  std::vector<int> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto count =
      std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(kCorneaShare * static_cast<double>(order.size())));
  std::nth_element(order.begin(), order.begin() + count, order.end(),
                   [&](int a, int b) { return distance(a) != distance(b) ? distance(a) > distance(b) : a < b; });
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (auto i = order.begin(); i != order.begin() + count; ++i) sum += from_centre.row(*i).transpose();
  return sum.norm() > 0 ? Eigen::Vector3f(sum.normalized()) : Eigen::Vector3f(0, 0, 1);
}

}  // namespace

std::vector<Eyeball> find_eyeballs(const Head& head) {
  std::vector<Eyeball> eyes;
  for (const SurfaceMesh& mesh : head.figure.meshes) {
    if (mesh.material != Material::kEye) continue;
    const float middle = mesh.vertices.col(0).mean();
    for (const bool left : {true, false}) {
      std::vector<int> rows;
      for (int v = 0; v < mesh.vertices.rows(); ++v) {
        if ((mesh.vertices(v, 0) > middle) == left) rows.push_back(v);
      }
      if (rows.size() < 8) continue;
      const Eigen::MatrixX3f points = mesh.vertices(rows, Eigen::all);
      Eyeball eye = fit_sphere(points);
      eye.gaze = farthest_bulge(points, eye);
      // A plain sphere has no cornea, and its farthest vertex is rounding: such an eye looks straight ahead.
      const float bulge = ((points.rowwise() - eye.centre.transpose()).rowwise().norm().maxCoeff()) / eye.radius_m;
      if (bulge < 1.01F || eye.gaze.z() < 0.5F) eye.gaze = Eigen::Vector3f(0, 0, 1);
      eyes.push_back(eye);
    }
  }
  return eyes;
}

}  // namespace faceprobe::synth

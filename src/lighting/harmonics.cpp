#include "faceprobe/lighting/harmonics.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sh.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {

Eigen::MatrixX3d fit_harmonics(const Observations& observations, int order, double ridge) {
  if (order < 0 || order > 4) throw std::invalid_argument("The order of harmonics from shading must be 0 to 4.");
  if (!(ridge > 0)) throw std::invalid_argument("The ridge must be above 0.");
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const int count = sh::coefficient_count(order);
  Eigen::VectorXd transfer(count);  // radiance to shading: the cosine's over pi
  for (int l = 0; l <= order; ++l) transfer.segment(l * l, 2 * l + 1).setConstant(sh::cosine_lobe(l) / kPi);
  Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  double weight_sum = 0;
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    if (observations.clipped.row(i).any()) continue;
    const auto weight = static_cast<double>(observations.weight[i]);
    const Eigen::VectorXd row =
        sh::basis(order, Eigen::Vector3d(observations.normal.row(i).transpose().cast<double>())).cwiseProduct(transfer);
    normal_matrix += weight * row * row.transpose();
    right += weight * row * observations.shading.row(i).cast<double>().eval();
    weight_sum += weight;
  }
  if (!(weight_sum > 0)) return right;
  normal_matrix.diagonal().array() += ridge * weight_sum;
  return normal_matrix.ldlt().solve(right);
}

Eigen::MatrixX3f radiance_of_harmonics(const Eigen::MatrixX3d& coefficients, const SphereGrid& grid) {
  const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients.rows())))) - 1;
  if (order < 0 || coefficients.rows() != sh::coefficient_count(order))
    throw std::invalid_argument("The number of harmonics must be a square.");
  Eigen::MatrixX3f radiance(grid.cell_count(), 3);
  for (int j = 0; j < grid.cell_count(); ++j)
    radiance.row(j) =
        (sh::basis(order, grid.direction(j).cast<double>()).transpose() * coefficients).cwiseMax(0.0).cast<float>();
  return radiance;
}

}  // namespace faceprobe::lighting

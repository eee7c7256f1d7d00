#include "pipeline/unwrap_warp.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {
namespace {

double kernel(double squared_distance) {
  return squared_distance > 1e-20 ? 0.5 * squared_distance * std::log(squared_distance) : 0.0;
}

}  // namespace

ThinPlateWarp::ThinPlateWarp(const Eigen::MatrixX2f& from, const Eigen::MatrixX2f& to, double softness) {
  const Eigen::Index count = from.rows();
  const Eigen::MatrixX2d start = from.cast<double>();
  origin_ = start.colwise().mean().transpose();
  scale_ = 1.0 / std::max(1e-9, (start.rowwise() - origin_.transpose()).cwiseAbs().maxCoeff());
  centre_ = (start.rowwise() - origin_.transpose()) * scale_;
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 3, count + 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) system(i, j) = kernel((centre_.row(i) - centre_.row(j)).squaredNorm());
    system(i, i) += softness;
  }
  system.block(0, count, count, 1).setOnes();
  system.block(0, count + 1, count, 2) = centre_;
  system.bottomLeftCorner(3, count) = system.topRightCorner(count, 3).transpose();
  Eigen::MatrixX2d shift = Eigen::MatrixX2d::Zero(count + 3, 2);
  shift.topRows(count) = to.cast<double>() - start;
  weight_ = system.partialPivLu().solve(shift);
}

Eigen::Vector2f ThinPlateWarp::operator()(const Eigen::Vector2f& point) const {
  const Eigen::Index count = centre_.rows();
  const Eigen::Vector2d p = (point.cast<double>() - origin_) * scale_;
  Eigen::Vector2d shift =
      (weight_.row(count) + p.x() * weight_.row(count + 1) + p.y() * weight_.row(count + 2)).transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    shift += kernel((centre_.row(i).transpose() - p).squaredNorm()) * weight_.row(i).transpose();
  }
  return point + shift.cast<float>();
}

}  // namespace faceprobe::pipeline

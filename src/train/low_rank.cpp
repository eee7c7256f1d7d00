#include "train/low_rank.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {

namespace {

// Rounding leaves about 1e-16 sigma1 per entry of what should be zero.
constexpr double kRankOneShare = 1e-13;

struct LargestPair {
  double value;            // singular value
  Eigen::VectorXd vector;  // left singular vector, k
};

LargestPair largest_pair(const Eigen::MatrixXd& d) {
  const Eigen::MatrixXd gram = d * d.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);  // eigenvalues in increasing order
  const Eigen::Index last = gram.rows() - 1;
  return {std::sqrt(std::max(0.0, solver.eigenvalues()(last))), solver.eigenvectors().col(last)};
}

// D without its first singular pair: the smaller singular values stay, without the rounding of the large one.
struct Deflated {
  double sigma1;
  Eigen::MatrixXd rest;
};

Deflated deflate(const Eigen::MatrixXd& d, double pixels) {
  if (d.rows() < 2 || d.cols() < 1)
    throw std::invalid_argument("A low-rank loss needs two photos or more, and pixels.");
  if (!(pixels > 0)) throw std::invalid_argument("The mask of a low-rank loss is empty.");
  if (!d.allFinite()) throw std::invalid_argument("A low-rank loss needs finite chromaticities.");
  const LargestPair first = largest_pair(d);
  return {first.value, d - first.vector * (first.vector.transpose() * d)};
}

LowRankLoss scaled(double value, Eigen::MatrixXd gradient, double pixels) {
  const double scale = 1 / std::sqrt(pixels);
  return {value * scale, gradient * scale};
}

LowRankLoss none(const Eigen::MatrixXd& d) { return {0, Eigen::MatrixXd::Zero(d.rows(), d.cols())}; }

}  // namespace

LowRankLoss sigma2(const Eigen::MatrixXd& d, double pixels) {
  const Deflated deflated = deflate(d, pixels);
  const LargestPair second = largest_pair(deflated.rest);
  if (second.value <= kRankOneShare * deflated.sigma1) return none(d);
  const Eigen::RowVectorXd v2 = second.vector.transpose() * deflated.rest / second.value;
  return scaled(second.value, second.vector * v2, pixels);
}

LowRankLoss distance_to_rank1(const Eigen::MatrixXd& d, double pixels) {
  const Deflated deflated = deflate(d, pixels);
  const double distance = deflated.rest.norm();
  if (distance <= kRankOneShare * deflated.sigma1) return none(d);
  return scaled(distance, deflated.rest / distance, pixels);
}

}  // namespace faceprobe::train

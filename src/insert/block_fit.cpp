#include "insert/block_fit.h"

#include "insert/gaussian.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace faceprobe::insert {
namespace {

constexpr int kTerms = 3;
constexpr int kPixels = kBlockSide * kBlockSide;
constexpr int kNeighbours = 2 * kBlockSide * (kBlockSide - 1);
constexpr float kLargestCorrelation = 4;  // a block of 16 pixels tells no more

// Along one axis, of white noise that went through a discrete Gaussian: at distance n it is I_n(2 t) / I_0(2 t).
Block correlation_matrix(float correlation_px) {
  const std::vector<double> half = gaussian_kernel(std::sqrt(2.0) * static_cast<double>(correlation_px));
  Block matrix;
  for (int i = 0; i < kBlockSide; ++i) {
    for (int j = 0; j < kBlockSide; ++j) {
      const auto distance = static_cast<std::size_t>(std::abs(i - j));
      matrix(i, j) = distance < half.size() ? half[distance] / half[0] : 0.0;
    }
  }
  return matrix;
}

double next_sum(const Block& matrix) { return matrix.diagonal<1>().sum(); }

}  // namespace

// On a grid about 0 the constant and the slope are at right angles, and the square is once its mean is out.
BlockFit::BlockFit() {
  Eigen::Matrix<double, kBlockSide, kTerms> basis;
  for (int i = 0; i < kBlockSide; ++i) {
    const double x = i - (kBlockSide - 1) / 2.0;
    basis.row(i) << 1, x, x * x - (kPixels - 1) / 12.0;
  }
  projector_.setZero();
  for (int k = 0; k < kTerms; ++k) {
    projector_ += basis.col(k) * basis.col(k).transpose() / basis.col(k).squaredNorm();
  }
}

// The noise's covariance is the Kronecker product of C with itself, what is removed that of P with itself, so traces and sums over
// neighbours are products of those along the axes.
Moments BlockFit::expected(float correlation_px) const {
  const Block C = correlation_matrix(correlation_px);
  const Block PC = projector_ * C;
  const Block PCP = PC * projector_;
  const double variance = C.trace() * C.trace() - PC.trace() * PC.trace();
  const double across =
      next_sum(C) * C.trace() - (next_sum(PC) + next_sum(PC.transpose())) * PC.trace() + next_sum(PCP) * PCP.trace();
  return {variance / kPixels, 2 * across / kNeighbours};
}

Moments moments_of(const Block& residual) {
  constexpr int kLast = kBlockSide - 1;
  const double down = residual.topRows<kLast>().cwiseProduct(residual.bottomRows<kLast>()).sum();
  const double across = residual.leftCols<kLast>().cwiseProduct(residual.rightCols<kLast>()).sum();
  return {residual.squaredNorm() / kPixels, (down + across) / kNeighbours};
}

float correlation_of(const BlockFit& fit, double ratio) {
  float low = 0;
  float high = kLargestCorrelation;
  for (int i = 0; i < 20; ++i) {
    const float middle = (low + high) / 2;
    const Moments would_be = fit.expected(middle);
    (would_be.covariance / would_be.variance < ratio ? low : high) = middle;
  }
  return low;
}

}  // namespace faceprobe::insert

#pragma once
// Takes slow shading out of a square block, and knows what share of the grain goes with it: soft grain is partly slow too, so that
// without this its sigma and its correlation both read too small.
//
//   const BlockFit fit;
//   fit.remove(block);                                                 // the products of two parabolas, across and down
//   const float px = correlation_of(fit, covariance / variance);
//   const double whole = variance / fit.expected(px).variance;

#include <Eigen/Core>

namespace faceprobe::insert {

inline constexpr int kBlockSide = 16;
using Block = Eigen::Matrix<double, kBlockSide, kBlockSide>;

// Mean square, and mean product of neighbours across and down.
struct Moments {
  double variance = 0;
  double covariance = 0;
};
Moments moments_of(const Block& residual);

class BlockFit {
 public:
  BlockFit();
  // Leaves the residual.
  void remove(Block& values) const { values -= projector_ * values * projector_; }
  // Of the residual of noise that had a variance of 1 before, and is as soft as a discrete Gaussian of that deviation.
  Moments expected(float correlation_px) const;

 private:
  Block projector_;  // onto parabolas
};

// The correlation whose residual has this ratio of covariance to variance; 0 .. 4 px.
float correlation_of(const BlockFit& fit, double ratio);

}  // namespace faceprobe::insert

#pragma once
// The unsupervised loss of "Faces as Lighting Probes", Section 3.2: the diffuse chromaticity of one person is the same
// in every photo, so the matrix D whose rows are the photos should have rank one, and what it has beyond that is the
// fault of the separation.
//
//   Eigen::MatrixXd d(4, 2 * pixels);                       // rows from train/chromaticity.h, one per photo
//   const LowRankLoss loss = distance_to_rank1(d, pixels);  // an optimiser follows loss.gradient back through the rows
//
// Not for photos under lights of different colours: those differ by more than one rank, whatever the separation did.
// Make the colours agree first (train/histogram_transfer.h). Rank one also has trivial solutions;
// train/finetune_guards.h knows them.

#include <Eigen/Core>

namespace faceprobe::train {

struct LowRankLoss {
  double value = 0;
  Eigen::MatrixXd gradient;  // of `value` by the entries of D; k x M
};

// Both take D, k x M with k >= 2 photos, and `pixels`, the size of the mask (the sum of the weights where it is
// weighted), > 0. Value and gradient are divided by sqrt(pixels): with the mask seen at another resolution all singular
// values grow as that root, so that the loss is the root mean square over pixels and the same at any resolution. pixels
// = 1 leaves them as the paper has them. (The authors' later code divides by the mask size itself and multiplies by
// 100, which is not independent of resolution.)
//
// Everything goes through k x k Gram matrices in double, O(k^2 M). The second one is that of D without its first
// singular pair, so that a value is good to about 1e-15 of sigma1 rather than to the square root of that. Below 1e-13
// of sigma1 D counts as rank one: value and gradient are 0. Throws std::invalid_argument: fewer than two rows, no
// column, pixels not positive, values that are not finite.

// The paper's loss (Equation 2): the second singular value; d sigma2 / d D_ij = U_i2 V_j2. Where sigma2 = sigma3 this
// is only a subgradient, and an optimiser jumps between the two.
LowRankLoss sigma2(const Eigen::MatrixXd& d, double pixels = 1);

// sqrt(sum over n >= 2 of sigma_n^2): the Frobenius distance from D to the nearest matrix of rank one, and what the
// authors moved to later. Its gradient, (D - rank1(D)) / distance, is smooth wherever sigma1 > sigma2 and the distance
// is not 0: also at sigma2 = sigma3. Preferred.
LowRankLoss distance_to_rank1(const Eigen::MatrixXd& d, double pixels = 1);

}  // namespace faceprobe::train

#include "train/low_rank.h"

#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace faceprobe::train {
namespace {

using Loss = std::function<LowRankLoss(const Eigen::MatrixXd&)>;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random({seed});
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

Eigen::MatrixXd random_rotation(Eigen::Index size, std::uint64_t seed) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(random_matrix(size, size, seed)).householderQ();
}

// A matrix with the given singular values and random singular vectors.
Eigen::MatrixXd with_singular_values(const Eigen::VectorXd& values, Eigen::Index columns, std::uint64_t seed) {
  return random_rotation(values.size(), seed) * values.asDiagonal() *
         random_rotation(columns, seed + 1).topRows(values.size());
}

// Largest difference between the gradient and central differences, relative to the largest entry of the gradient.
double gradient_error(const Loss& loss, const Eigen::MatrixXd& d) {
  constexpr double kStep = 1e-5;
  const Eigen::MatrixXd gradient = loss(d).gradient;
  double worst = 0;
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    for (Eigen::Index j = 0; j < d.cols(); ++j) {
      Eigen::MatrixXd up = d;
      Eigen::MatrixXd down = d;
      up(i, j) += kStep;
      down(i, j) -= kStep;
      const double slope = (loss(up).value - loss(down).value) / (2 * kStep);
      worst = std::max(worst, std::abs(slope - gradient(i, j)));
    }
  }
  return worst / gradient.cwiseAbs().maxCoeff();
}

const Loss kSigma2 = [](const Eigen::MatrixXd& d) { return sigma2(d); };
const Loss kDistance = [](const Eigen::MatrixXd& d) { return distance_to_rank1(d); };

TEST(LowRank, ValuesAreThoseOfTheSingularValueDecomposition) {
  const Eigen::MatrixXd d = random_matrix(4, 30, 1);
  const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(d).singularValues();
  // Two decompositions in double of a matrix of order 1.
  EXPECT_NEAR(sigma2(d).value, s(1), 1e-12);
  EXPECT_NEAR(distance_to_rank1(d).value, s.tail(3).norm(), 1e-12);
  // The formula's gradient, from the decomposition.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(d, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::MatrixXd expected = svd.matrixU().col(1) * svd.matrixV().col(1).transpose();
  EXPECT_LT((sigma2(d).gradient - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LowRank, GradientsAreThoseOfFiniteDifferences) {
  // Central differences with a step of 1e-5 err by step^2 / gap^2 ~ 1e-10 and by rounding 1e-16 / 1e-5 = 1e-11, over
  // gradients of order .1.
  const Eigen::MatrixXd distinct = with_singular_values(Eigen::Vector4d(8, 3, 2, 1), 24, 2);
  EXPECT_LT(gradient_error(kSigma2, distinct), 1e-6);
  EXPECT_LT(gradient_error(kDistance, distinct), 1e-6);
  EXPECT_LT(gradient_error(kSigma2, random_matrix(5, 18, 3)), 1e-6);
  EXPECT_LT(gradient_error(kDistance, random_matrix(2, 18, 3)), 1e-6);
}

TEST(LowRank, DistanceIsSmoothWhereSigma2EqualsSigma3AndSigma2IsNot) {
  const Eigen::MatrixXd tied = with_singular_values(Eigen::Vector4d(8, 2, 2, 1), 24, 4);
  EXPECT_LT(gradient_error(kDistance, tied), 1e-6);  // the same differences as above
  // sigma2 has a kink there: the differences are wrong by the order of the gradient itself, which shows that this test
  // can tell.
  EXPECT_GT(gradient_error(kSigma2, tied), 0.1);
}

TEST(LowRank, RankOneCostsNothing) {
  const Eigen::VectorXd gains = Eigen::Vector4d(1, 0.5, 2, 0.9);
  const Eigen::MatrixXd d = gains * random_matrix(1, 500, 5).cwiseAbs();
  for (const Loss& loss : {kSigma2, kDistance}) {
    EXPECT_EQ(loss(d).value, 0);
    EXPECT_TRUE(loss(d).gradient.isZero(0));
    EXPECT_EQ(loss(Eigen::MatrixXd::Zero(4, 6)).value, 0) << "no division by zero";
    EXPECT_TRUE(loss(Eigen::MatrixXd::Zero(4, 6)).gradient.allFinite());
  }
}

TEST(LowRank, SmallSecondValuesAreNotLostInTheGramMatrix) {
  // sigma2 = 1e-10 sigma1 is far below the square root of the rounding, where a plain Gram matrix sees noise only.
  const Eigen::MatrixXd d = with_singular_values(Eigen::Vector3d(1, 1e-10, 3e-11), 40, 6);
  EXPECT_NEAR(sigma2(d).value, 1e-10, 1e-14);  // rounding of entries of order .1, added over 120 of them
  EXPECT_NEAR(distance_to_rank1(d).value, std::hypot(1e-10, 3e-11), 1e-14);
}

TEST(LowRank, FollowsScaleAndRotation) {
  const Eigen::MatrixXd d = with_singular_values(Eigen::Vector4d(8, 3, 2, 1), 24, 7);
  const Eigen::MatrixXd turn = random_rotation(4, 8);
  const Eigen::MatrixXd turn_pixels = random_rotation(24, 9);
  for (const Loss& loss : {kSigma2, kDistance}) {
    const LowRankLoss here = loss(d);
    // Products of matrices of order 10 in double.
    EXPECT_NEAR(loss(-3 * d).value, 3 * here.value, 1e-12);
    EXPECT_LT((loss(3 * d).gradient - here.gradient).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(loss(turn * d).value, here.value, 1e-12);
    EXPECT_LT((loss(turn * d).gradient - turn * here.gradient).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((loss(d * turn_pixels).gradient - here.gradient * turn_pixels).cwiseAbs().maxCoeff(), 1e-12);
    // Homogeneous of degree one (Euler): <gradient, D> = value.
    EXPECT_NEAR(here.gradient.cwiseProduct(d).sum(), here.value, 1e-12);
  }
}

TEST(LowRank, PerPixelItDoesNotDependOnTheResolution) {
  const Eigen::MatrixXd coarse = random_matrix(4, 20, 10);
  const Eigen::MatrixXd fine = coarse.replicate(1, 4);  // each pixel seen as four
  EXPECT_NEAR(sigma2(fine, 40).value, sigma2(coarse, 10).value, 1e-12);
  EXPECT_NEAR(distance_to_rank1(fine, 40).value, distance_to_rank1(coarse, 10).value, 1e-12);
  EXPECT_NEAR(sigma2(coarse, 25).value, sigma2(coarse).value / 5, 1e-12);
  EXPECT_LT((sigma2(coarse, 25).gradient - sigma2(coarse).gradient / 5).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LowRank, RefusesWhatItCannotMeasure) {
  EXPECT_THROW(sigma2(Eigen::MatrixXd::Ones(1, 8)), std::invalid_argument);
  EXPECT_THROW(sigma2(Eigen::MatrixXd::Ones(3, 0)), std::invalid_argument);
  EXPECT_THROW(distance_to_rank1(Eigen::MatrixXd::Ones(3, 8), 0), std::invalid_argument);
  Eigen::MatrixXd broken = Eigen::MatrixXd::Ones(3, 8);
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(distance_to_rank1(broken), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train

#include "lighting/robust_rows.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace faceprobe::lighting {
namespace {

// Rows of random shapes, their data of known unknowns.
RobustRows random_rows(Eigen::Index count, const Unknowns& x, Eigen::VectorXd& light, double noise, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  RobustRows rows;
  rows.surround.resize(count, kSurround);
  light.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (int k = 0; k < kSurround; ++k) rows.surround(i, k) = uniform(random);
    light[i] = uniform(random);
  }
  rows.data = rows.surround * x.head<kSurround>() + x[kSurround] * light;
  for (Eigen::Index i = 0; i < count; ++i) rows.data[i] += noise * normal(random);
  rows.weight.setOnes(count);
  rows.bound.setConstant(count, false);
  rows.scale = 0.01;
  rows.independent = static_cast<double>(count);
  return rows;
}

Unknowns some_unknowns() { return (Unknowns() << 0.9, 0.2, 0, 0.4, 0, 0.1, 0, 1.5).finished(); }

TEST(RobustRows, NonNegativeSolutionsFulfilTheirConditions) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    UnknownsMatrix a;
    Unknowns b;
    for (int i = 0; i < kUnknowns; ++i) {
      b[i] = normal(random);
      for (int j = 0; j < kUnknowns; ++j) a(i, j) = normal(random);
    }
    const UnknownsMatrix h = a.transpose() * a;
    const Unknowns g = a.transpose() * b;
    const Unknowns x = non_negative_solution(h, g);
    const Unknowns slope = h * x - g;
    // Karush, Kuhn and Tucker: not negative, no way down that is allowed, no slope along what is free.
    EXPECT_GE(x.minCoeff(), 0) << trial;
    EXPECT_GT(slope.minCoeff(), -1e-6) << trial;  // random matrices of condition numbers up to some 1e3, squared
    for (int i = 0; i < kUnknowns; ++i) {
      if (x[i] > 1e-9) {
        EXPECT_NEAR(slope[i], 0, 1e-6) << trial;
      }
    }
  }
}

TEST(RobustRows, AnUnknownThatNothingShowsStaysZero) {
  UnknownsMatrix h = UnknownsMatrix::Identity();
  h(3, 3) = 0;
  const Unknowns x = non_negative_solution(h, Unknowns::Ones());
  EXPECT_EQ(x[3], 0);
  EXPECT_NEAR(x[0], 1, 1e-12);
  EXPECT_TRUE(non_negative_solution(UnknownsMatrix::Zero(), Unknowns::Zero()).isZero());
}

TEST(RobustRows, UnknownsComeBackAlsoAmongOutliers) {
  Eigen::VectorXd light;
  RobustRows rows = random_rows(400, some_unknowns(), light, 0.01);
  EXPECT_LT((fit_rows(rows, light).x - some_unknowns()).norm(),
            0.03);  // .01 noise over 400 rows of columns that are uneven by .3: .002 each
  for (Eigen::Index i = 0; i < 40; ++i) rows.data[10 * i] += 2;
  // 200 scales off, each counts a ten-thousandth of another.
  EXPECT_LT((fit_rows(rows, light).x - some_unknowns()).norm(), 0.04);
}

TEST(RobustRows, BoundsPullOneWay) {
  Eigen::VectorXd light;
  RobustRows rows = random_rows(400, some_unknowns(), light, 0);
  for (Eigen::Index i = 0; i < 100; ++i) {
    rows.data[i] *= 0.5;
    rows.bound[i] = true;
  }
  const RowsFit fit = fit_rows(rows, light);
  EXPECT_LT((fit.x - some_unknowns()).norm(), 0.01);  // without noise, but for the prior
  EXPECT_EQ(fit.residual.head(100).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(fit.influence.head(100).maxCoeff(), 0);
}

TEST(RobustRows, TheScaleIsTheNoises) {
  Eigen::VectorXd light;
  RobustRows rows = random_rows(2000, some_unknowns(), light, 0.05);
  rows.scale = 0.05;
  EXPECT_NEAR(robust_scale(rows, fit_rows(rows, light).residual), 0.05, 0.005);  // a median of 2000: 3 %, threefold
  // As many units, as wide: the cost is about one a row, less what the logarithm takes off and the unknowns fit.
  EXPECT_NEAR(fit_rows(rows, light).cost / 2000, 0.8, 0.1);
  EXPECT_GT(robust_scale(rows, Eigen::VectorXd::Zero(2000)), 0);
}

TEST(RobustRows, RowsThatAreWrongAlikeCountAsFewer) {
  // Normals over the front half of a ball.
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr Eigen::Index kCount = 600;
  Eigen::MatrixX3f normals(kCount, 3);
  for (Eigen::Index i = 0; i < kCount; ++i) {
    Eigen::Vector3d d(normal(random), normal(random), normal(random));
    d.z() = std::abs(d.z());
    normals.row(i) = d.normalized().cast<float>().transpose();
  }
  RobustRows rows;
  rows.data.setOnes(kCount);
  rows.weight.setOnes(kCount);
  rows.bound.setConstant(kCount, false);
  rows.scale = 1;
  Eigen::VectorXd each(kCount);
  Eigen::VectorXd broad(kCount);
  for (Eigen::Index i = 0; i < kCount; ++i) {
    each[i] = normal(random);
    broad[i] = std::sin(6 * static_cast<double>(normals(i, 0))) * std::cos(5 * static_cast<double>(normals(i, 1)));
  }
  EXPECT_GT(independent_rows(rows, each, normals), 0.4 * kCount);  // by chance some bins correlate a little
  EXPECT_LE(independent_rows(rows, each, normals), kCount);
  EXPECT_LT(independent_rows(rows, broad, normals), 0.15 * kCount);
  EXPECT_GT(independent_rows(rows, broad, normals), 5);  // its bumps
}

}  // namespace
}  // namespace faceprobe::lighting

#include "train/chromaticity.h"

#include "faceprobe/core/random.h"
#include "train/low_rank.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace faceprobe::train {
namespace {

constexpr int kWidth = 9;
constexpr int kHeight = 7;

Eigen::MatrixX3d random_picture(double low, double high, std::uint64_t seed) {
  Random random({seed});
  return Eigen::MatrixX3d::NullaryExpr(kWidth * kHeight, 3, [&] { return random.between(low, high); });
}

// A round mask with soft weights and a hole.
Image round_mask() {
  Image mask(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      mask(x, y) = std::max(0.0F, 1.2F - 0.3F * std::hypot(static_cast<float>(x) - 4, static_cast<float>(y) - 3));
    }
  }
  mask(5, 3) = 0;
  return mask;
}

Image full_mask() { return Image(kWidth, kHeight, 1, 1.0F); }

TEST(Chromaticity, IsTheSharesOfRedAndGreen) {
  const Chromaticity chromaticity(full_mask());
  Eigen::MatrixX3d diffuse = random_picture(0.1, 1, 1);
  diffuse.row(11) << 0.2, 0.3, 0.5;
  const Eigen::RowVectorXd row = chromaticity.row(diffuse);
  ASSERT_EQ(row.size(), 2 * kWidth * kHeight);
  EXPECT_NEAR(row(11), 0.2, 1e-15);
  EXPECT_NEAR(row(kWidth * kHeight + 11), 0.3, 1e-15);
  // Light and its strength are not in it: a gain per pixel changes nothing beyond rounding.
  const Eigen::VectorXd shading = random_picture(0.2, 3, 2).col(0);
  EXPECT_LT((chromaticity.row(shading.asDiagonal() * diffuse) - row).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Chromaticity, DarknessFadesToZeroAndStaysFinite) {
  const Chromaticity chromaticity(full_mask(), {.floor = 0.01F});
  Eigen::MatrixX3d diffuse = random_picture(0.1, 1, 1);
  diffuse.row(0).setZero();
  diffuse.row(1) << -0.5, -0.1, -0.2;
  diffuse.row(2) << 1e-3, 2e-3, 2e-3;  // half the floor
  const Eigen::RowVectorXd row = chromaticity.row(diffuse);
  EXPECT_EQ(row(0), 0);
  EXPECT_EQ(row(1), 0);
  EXPECT_NEAR(row(2), 0.1, 1e-7);  // the floor is a float
  const Eigen::MatrixX3d gradient = chromaticity.backward(diffuse, Eigen::RowVectorXd::Ones(row.size()));
  EXPECT_TRUE(gradient.allFinite());
  EXPECT_TRUE(gradient.row(1).isZero(0)) << "clipped channels do not move";
}

TEST(Chromaticity, BlurStaysInsideTheMaskAndKeepsConstants) {
  const Image mask = round_mask();
  const Chromaticity blurred(mask, {.blur_sigma_px = 2});
  const Chromaticity sharp(mask);
  Eigen::MatrixX3d diffuse = Eigen::RowVector3d(0.5, 0.3, 0.2).replicate(kWidth * kHeight, 1);
  EXPECT_LT((blurred.row(diffuse) - sharp.row(diffuse)).cwiseAbs().maxCoeff(), 1e-15);  // rounding of the sums
  // What is outside may be anything.
  Eigen::MatrixX3d other = diffuse;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    if (mask.data()[i] == 0) other.row(i) << 1e6, 0, -3;
  }
  EXPECT_EQ(blurred.row(other), blurred.row(diffuse));
  EXPECT_TRUE(blurred.backward(other, Eigen::RowVectorXd::Ones(2 * blurred.pixels())).row(0).isZero(0));
  // And it does blur: variation of random colours shrinks to less than half over five pixels' width.
  const Chromaticity full(full_mask(), {.blur_sigma_px = 2});
  const auto variation = [](const Eigen::RowVectorXd& row) {
    const Eigen::RowVectorXd red = row.head(kWidth * kHeight);
    return std::sqrt((red.array() - red.mean()).square().mean());
  };
  diffuse = random_picture(0.1, 1, 4);
  EXPECT_LT(variation(full.row(diffuse)), 0.5 * variation(Chromaticity(full_mask()).row(diffuse)));
}

TEST(Chromaticity, WeightsCountInSquares) {
  // A pixel with weight 4 stands for four pixels: the norm of the row is the same.
  Image once(2, 1, 1, 1.0F);
  once(0, 0) = 4;
  Eigen::MatrixX3d two(2, 3);
  two << 0.5, 0.3, 0.2, 0.2, 0.2, 0.6;
  Eigen::MatrixX3d five(5, 3);
  five << two.row(0), two.row(0), two.row(0), two.row(0), two.row(1);
  EXPECT_NEAR(Chromaticity(once).row(two).norm(), Chromaticity(Image(5, 1, 1, 1.0F)).row(five).norm(), 1e-14);
  EXPECT_EQ(Chromaticity(once).weight_sum(), 5);
}

// <J v, g> = <v, J^T g>, where J v is a central difference along v.
TEST(Chromaticity, BackwardIsTheAdjointOfTheDifferential) {
  for (const float sigma : {0.0F, 1.5F, 3.0F}) {
    const Chromaticity chromaticity(round_mask(), {.floor = 0.3F, .blur_sigma_px = sigma});
    // Sums from 0 to 1.2, so that some pixels are under the floor; none within the step of it or of 0.
    const Eigen::MatrixX3d diffuse = random_picture(-0.05, 0.4, 6);
    const Eigen::MatrixX3d direction = random_picture(-1, 1, 7);
    const Eigen::RowVectorXd by_row =
        random_picture(-1, 1, 8).reshaped<Eigen::RowMajor>(1, 3 * kWidth * kHeight).leftCols(2 * chromaticity.pixels());
    const double step = 1e-6;
    const Eigen::RowVectorXd along =
        (chromaticity.row(diffuse + step * direction) - chromaticity.row(diffuse - step * direction)) / (2 * step);
    const double forward = along.dot(by_row);
    const double backward = chromaticity.backward(diffuse, by_row).cwiseProduct(direction).sum();
    // The difference errs by step^2 times third derivatives of order 1 / floor^3 and by rounding 1e-16 / 1e-6.
    EXPECT_NEAR(forward, backward, 1e-8) << "sigma " << sigma;
    EXPECT_GT(std::abs(forward), 1e-2) << "not a test of zero";
  }
}

TEST(Chromaticity, LowRankGradientReachesThePicture) {
  const Chromaticity chromaticity(round_mask(), {.blur_sigma_px = 1.5F});
  std::vector<Eigen::MatrixX3d> diffuse;
  for (std::uint64_t k = 0; k < 4; ++k) diffuse.push_back(random_picture(0.1, 1, 10 + k));
  const auto loss = [&] {
    Eigen::MatrixXd d(4, 2 * chromaticity.pixels());
    for (int k = 0; k < 4; ++k) d.row(k) = chromaticity.row(diffuse[static_cast<std::size_t>(k)]);
    return distance_to_rank1(d, chromaticity.weight_sum());
  };
  const Eigen::MatrixX3d gradient = chromaticity.backward(diffuse[2], loss().gradient.row(2));
  const double largest = gradient.cwiseAbs().maxCoeff();
  const double step = 1e-5;
  for (const int pixel : {3 * kWidth + 4, 2 * kWidth + 3, 4 * kWidth + 6}) {
    for (int c = 0; c < 3; ++c) {
      const double here = diffuse[2](pixel, c);
      diffuse[2](pixel, c) = here + step;
      const double up = loss().value;
      diffuse[2](pixel, c) = here - step;
      const double down = loss().value;
      diffuse[2](pixel, c) = here;
      EXPECT_NEAR((up - down) / (2 * step), gradient(pixel, c), 1e-6 * largest);  // step^2 over values of order .1 to 1
    }
  }
}

TEST(Chromaticity, PicturesAndMatricesConvert) {
  Image picture(3, 2, 3);
  picture(2, 1, 1) = 0.25F;
  const Eigen::MatrixX3d matrix = matrix_from_picture(picture);
  EXPECT_EQ(matrix(5, 1), 0.25);
  EXPECT_EQ(matrix.sum(), 0.25);
  EXPECT_EQ(picture_from_matrix(matrix, 3, 2), picture);
  EXPECT_THROW(picture_from_matrix(matrix, 3, 3), std::invalid_argument);
}

TEST(Chromaticity, RefusesMasksAndSizesThatDoNotFit) {
  EXPECT_THROW(Chromaticity(Image(4, 4, 1)), std::invalid_argument);
  EXPECT_THROW(Chromaticity(Image(4, 4, 1, -1.0F)), std::invalid_argument);
  EXPECT_THROW(Chromaticity(full_mask(), {.floor = 0}), std::invalid_argument);
  EXPECT_THROW(Chromaticity(full_mask(), {.blur_sigma_px = -1}), std::invalid_argument);
  EXPECT_THROW(Chromaticity(full_mask()).row(Eigen::MatrixX3d::Ones(5, 3)), std::invalid_argument);
  EXPECT_THROW(Chromaticity(full_mask()).backward(random_picture(0, 1, 1), Eigen::RowVectorXd::Ones(3)),
               std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train

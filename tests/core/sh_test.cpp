#include "faceprobe/core/sh.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe {
namespace {

TEST(Sh, FirstNineAgreeWithTheirPolynomials) {
  // Ramamoorthi & Hanrahan 2001, Eq. 3, with more digits.
  for (const Eigen::Vector3d& raw :
       {Eigen::Vector3d(0.3, -0.5, 0.8), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 2, -0.1)}) {
    const Eigen::Vector3d d = raw.normalized();
    const double x = d.x();
    const double y = d.y();
    const double z = d.z();
    const double c1 = std::sqrt(3 / (4 * kPi));
    const double c2 = std::sqrt(15 / (4 * kPi));
    const Eigen::VectorXd values = sh::basis(2, d);
    Eigen::VectorXd expected(9);
    expected << std::sqrt(1 / (4 * kPi)), c1 * y, c1 * z, c1 * x, c2 * x * y, c2 * y * z,
        std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1), c2 * x * z, c2 / 2 * (x * x - y * y);
    EXPECT_LE((values - expected).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Sh, BasisIsOrthonormal) {
  const int order = 6;
  const int count = sh::coefficient_count(order);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  // Midpoint rule on a product grid of 64 x 128: the integrands have degree 12, so only the polar rule errs, by about 1e-4.
  for (int i = 0; i < 64; ++i) {
    const double theta = kPi * (i + 0.5) / 64;
    for (int j = 0; j < 128; ++j) {
      const double phi = 2 * kPi * j / 128;
      const Eigen::Vector3d d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const Eigen::VectorXd y = sh::basis(order, d);
      gram += y * y.transpose() * (std::cos(kPi * i / 64) - std::cos(kPi * (i + 1) / 64)) * (2 * kPi / 128);
    }
  }
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 3e-3);
}

TEST(Sh, AdditionTheoremHoldsAtHighOrder) {
  // sum_m Y_lm(d)^2 = (2l + 1) / (4 pi) for every direction, poles included.
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0.64, 0.48), Eigen::Vector3d(0, -1, 0)}) {
    const Eigen::VectorXd y = sh::basis(12, d);
    for (int band = 0; band <= 12; ++band) {
      EXPECT_NEAR(y.segment(band * band, 2 * band + 1).squaredNorm(), (2 * band + 1) / (4 * kPi), 1e-12) << band;
    }
  }
}

TEST(Sh, CosineLobeMatchesQuadrature) {
  for (int band = 0; band <= 8; ++band) {
    // A_l = 2 pi int_0^1 z P_l(z) dz, by Simpson with 2000 steps (error below 1e-9 at these degrees).
    const auto f = [band](double z) { return z * std::legendre(static_cast<unsigned>(band), z); };
    double sum = 0;
    const int steps = 2000;
    for (int i = 0; i <= steps; ++i) {
      const double weight = i == 0 || i == steps ? 1 : (i % 2 == 1 ? 4 : 2);
      sum += weight * f(static_cast<double>(i) / steps);
    }
    EXPECT_NEAR(sh::cosine_lobe(band), 2 * kPi * sum / (3.0 * steps), 1e-8) << band;
  }
}

TEST(Sh, UniformLightGivesPiTimesRadianceAndALampItsCosine) {
  EnvMap map(128, 64);
  for (float& value : map.radiance().values()) value = 2.0F;
  const Eigen::MatrixX3d uniform = sh::project(map, 2);
  EXPECT_NEAR(sh::irradiance(uniform, {0, 1, 0})[0], 2 * kPi, 1e-3);

  EnvMap lamp(256, 128);
  lamp.radiance()(64, 64, 0) = 1.0F;  // near +x, half a texel off (0.7 deg)
  const double energy = lamp.integral()[0];
  const Eigen::MatrixX3d coefficients = sh::project(lamp, 8);
  // The cosine's own expansion cut at order 8 peaks at .986 (sum of A_l (2l + 1) / 4 pi); the lamp is 1 deg off the axis.
  EXPECT_NEAR(sh::irradiance(coefficients, {1, 0, 0})[0] / energy, 0.986, 0.002);
}

}  // namespace
}  // namespace faceprobe

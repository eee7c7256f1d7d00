#include "lighting/smooth_start.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/quantile.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

constexpr int kRounds = 12;
constexpr float kLobeExponent =
    8.0F;  // about 47 degrees across at half height: wider than any lamp, narrower than a cosine

}  // namespace

SmoothFit fit_smooth_light(const Observations& observations, const Eigen::VectorXf& shading,
                           const Eigen::Array<bool, Eigen::Dynamic, 1>& clipped) {
  SmoothFit fit;
  const Eigen::Index n = observations.count();
  fit.trust.setOnes(n);
  // Without a lamp yet, every patch counts as lit; the first solution is then the plain linear one.
  std::vector<char> lit(static_cast<std::size_t>(n), 1);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d normal_matrix = 1e-6 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (clipped[i]) continue;
      Eigen::Vector4d row(0, 0, 0, 1);
      if (lit[static_cast<std::size_t>(i)] != 0) row.head<3>() = observations.normal.row(i).transpose().cast<double>();
      const double w = observations.weight[i] * fit.trust[i];
      normal_matrix += w * row * row.transpose();
      right += w * shading[i] * row;
    }
    Eigen::Vector4d solution = normal_matrix.ldlt().solve(right);
    if (solution[3] < 0) {  // no negative surround: the lamp alone
      solution[3] = 0;
      solution.head<3>() = normal_matrix.topLeftCorner<3, 3>().ldlt().solve(right.head<3>());
    }
    fit.lamp = solution.head<3>().cast<float>();
    fit.ambient = static_cast<float>(solution[3]);
    std::vector<float> residuals;
    Eigen::VectorXf residual(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const float cosine = observations.normal.row(i).dot(fit.lamp.transpose());
      lit[static_cast<std::size_t>(i)] = cosine > 0 ? 1 : 0;
      residual[i] = std::abs(shading[i] - fit.ambient - std::max(0.0F, cosine));
      if (!clipped[i]) residuals.push_back(residual[i]);
    }
    // 1.48 median |r| estimates the standard deviation; 2.4 of it is the usual Cauchy scale (95 % efficient on clean data).
    const float scale = std::max(1e-6F, 2.4F * 1.48F * upper_median_of(std::move(residuals)));
    for (Eigen::Index i = 0; i < n; ++i) {
      const float r = residual[i] / scale;
      fit.trust[i] = 1.0F / (1.0F + r * r);
    }
  }
  return fit;
}

Eigen::VectorXf smooth_radiance(const SmoothFit& fit, const SphereGrid& grid, float level) {
  const float strength = fit.lamp.norm();
  const Eigen::Vector3f direction = strength > 0 ? Eigen::Vector3f(fit.lamp / strength) : Eigen::Vector3f::UnitZ();
  // A lamp of irradiance E gives shading E / pi; the normalised lobe is (k + 1) / (2 pi) cos^k.
  const float peak = static_cast<float>(kPi) * strength * (kLobeExponent + 1.0F) / (2.0F * static_cast<float>(kPi));
  // Multiplicative steps cannot leave zero: nothing starts below a twentieth of the mean level.
  const float floor = std::max(fit.ambient, 0.05F * level);
  return (floor + peak * (grid.directions() * direction).array().max(0.0F).pow(kLobeExponent)).matrix();
}

}  // namespace faceprobe::lighting

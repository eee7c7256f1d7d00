#include "pipeline/unwrap_shading.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/core/sh.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {
namespace {

constexpr int kRounds = 15;
constexpr float kMinWeight = 0.05F;
constexpr float kDark = 1e-4F;       // linear light under which a logarithm says nothing
constexpr double kMaxShading = 1.2;  // |log|; beyond the fit is extrapolating
constexpr double kRidge = 1e-5;      // per sample, on all but the mean

using Basis = Eigen::Matrix<double, 9, 1>;

Basis basis_of(const float* normal) {
  const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3f>(normal).cast<double>().normalized();
  return sh::basis(2, n);
}

}  // namespace

double remove_slow_shading(const Image& normal, const Image& weight, Image& colour) {
  struct Texel {
    Basis basis;
    double log_light, weight;
  };
  std::vector<Texel> texels;
  // Every second texel each way: the fit has nine unknowns.
  const int step = colour.width() >= 128 ? 2 : 1;
  for (int y = 0; y < colour.height(); y += step) {
    for (int x = 0; x < colour.width(); x += step) {
      const float light = luminance(colour.pixel(x, y));
      if (weight(x, y) < kMinWeight || light < kDark) continue;
      texels.push_back(
          {basis_of(normal.pixel(x, y)), std::log(static_cast<double>(light)), static_cast<double>(weight(x, y))});
    }
  }
  if (texels.size() < 50) return 0.0;

  std::vector<double> logs;
  logs.reserve(texels.size());
  for (const Texel& texel : texels) logs.push_back(texel.log_light);
  Basis fit = Basis::Zero();
  fit[0] = upper_median_of(std::move(logs)) / texels.front().basis[0];
  std::vector<double> residual(texels.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < texels.size(); ++i) residual[i] = texels[i].log_light - fit.dot(texels[i].basis);
    std::vector<double> size(residual.size());
    std::transform(residual.begin(), residual.end(), size.begin(), [](double r) { return std::abs(r); });
    // Cauchy's weights at two deviations.
    const double scale = std::max(0.02, 2.0 * 1.4826 * upper_median_of(std::move(size)));
    Eigen::Matrix<double, 9, 9> normal_matrix = Eigen::Matrix<double, 9, 9>::Zero();
    Basis right = Basis::Zero();
    double total = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const double z = residual[i] / scale;
      const double w = texels[i].weight / (1.0 + z * z);
      normal_matrix.noalias() += w * texels[i].basis * texels[i].basis.transpose();
      right += w * texels[i].log_light * texels[i].basis;
      total += w;
    }
    normal_matrix.diagonal().tail(8).array() += kRidge * total;
    fit = normal_matrix.ldlt().solve(right);
  }

  double mean = 0;
  double square = 0;
  double total = 0;
  for (const Texel& texel : texels) {
    const double shading = fit.dot(texel.basis);
    mean += texel.weight * shading;
    square += texel.weight * shading * shading;
    total += texel.weight;
  }
  mean /= total;
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const float* n = normal.pixel(x, y);
      if (n[0] == 0.0F && n[1] == 0.0F && n[2] == 0.0F) continue;
      const double shading = std::clamp(fit.dot(basis_of(n)) - mean, -kMaxShading, kMaxShading);
      const auto gain = static_cast<float>(std::exp(-shading));
      for (int c = 0; c < 3; ++c) colour(x, y, c) *= gain;
    }
  }
  return std::sqrt(std::max(0.0, square / total - mean * mean));
}

}  // namespace faceprobe::pipeline

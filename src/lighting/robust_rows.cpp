#include "lighting/robust_rows.h"

#include "faceprobe/core/angles.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

using UnknownFlags = Eigen::Array<bool, kUnknowns, 1>;

constexpr int kWeightRounds = 4;       // of weights by residuals
constexpr double kLeastScale = 0.002;  // of the data: exact layers are never that exact
constexpr double kMostScales = 3;  // of a residual where correlations are reckoned: outliers tell nothing of neighbours
constexpr double kBinDeg = 6;
constexpr int kDistanceBins = 10;  // out to 60 degrees

double mean_size(const RobustRows& rows) {
  return std::sqrt(rows.weight.dot(rows.data.cwiseAbs2()) / std::max(1e-300, rows.weight.sum()));
}

// The unconstrained solution of the free unknowns, the others 0.
Unknowns solved(const UnknownsMatrix& h, const Unknowns& g, const UnknownFlags& free) {
  UnknownsMatrix matrix = UnknownsMatrix::Identity();
  Unknowns right = Unknowns::Zero();
  for (int i = 0; i < kUnknowns; ++i) {
    if (!free[i]) continue;
    right[i] = g[i];
    for (int j = 0; j < kUnknowns; ++j) {
      if (free[j]) matrix(i, j) = h(i, j);
    }
  }
  return matrix.ldlt().solve(right);
}

}  // namespace

Unknowns non_negative_solution(const UnknownsMatrix& h, const Unknowns& g) {
  constexpr double kEnough = 1e-9;
  Unknowns unit = Unknowns::Zero();  // in which all unknowns weigh alike
  for (int i = 0; i < kUnknowns; ++i) {
    if (h(i, i) > 0) unit[i] = 1 / std::sqrt(h(i, i));
  }
  const UnknownsMatrix matrix = unit.asDiagonal() * h * unit.asDiagonal();
  const Unknowns right = unit.cwiseProduct(g);
  const double enough = kEnough * right.cwiseAbs().maxCoeff();
  Unknowns x = Unknowns::Zero();
  UnknownFlags free = UnknownFlags::Constant(false);
  for (int round = 0; round < 3 * kUnknowns; ++round) {
    const Unknowns gain = right - matrix * x;
    int best = -1;
    for (int i = 0; i < kUnknowns; ++i) {
      if (!free[i] && gain[i] > (best < 0 ? enough : gain[best])) best = i;
    }
    if (best < 0) break;
    free[best] = true;
    while (true) {  // ends: each pass but the last takes one away
      const Unknowns wanted = solved(matrix, right, free);
      double step = 1;
      int first = -1;  // to reach zero on the way
      for (int i = 0; i < kUnknowns; ++i) {
        if (!free[i] || wanted[i] > 0) continue;
        const double reach = x[i] > 0 ? x[i] / (x[i] - wanted[i]) : 0;
        if (first >= 0 && reach >= step) continue;
        step = reach;
        first = i;
      }
      x += step * (wanted - x);
      if (first < 0) break;
      x[first] = 0;
      free[first] = false;
    }
  }
  return unit.cwiseProduct(x.cwiseMax(0.0));
}

Unknowns prior_precision() {
  Unknowns precision = Unknowns::Constant(0.1);  // of smooth light, in units of the map's ambient level
  precision[0] = 0.3;
  precision[kSurround] = 0;
  return precision;
}

RowsFit fit_rows(const RobustRows& rows, const Eigen::VectorXd& light) {
  Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> columns(rows.data.size(), kUnknowns);
  columns << rows.surround, light;
  const Unknowns precision = prior_precision();
  const double spread = rows.scale * rows.scale;
  const double each = rows.independent / std::max(1e-300, rows.weight.sum());
  RowsFit fit;
  fit.influence = rows.bound.select(0.0, rows.weight);
  for (int round = 0; round < kWeightRounds; ++round) {
    const Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> weighted =
        (each / spread * fit.influence).asDiagonal() * columns;
    UnknownsMatrix h = columns.transpose() * weighted;
    h.diagonal() += precision;
    Unknowns g = weighted.transpose() * rows.data;
    g[0] += precision[0];  // the map's expected factor is 1, that of all else 0
    fit.x = non_negative_solution(h, g);
    fit.residual = columns * fit.x - rows.data;
    for (Eigen::Index i = 0; i < fit.residual.size(); ++i) {
      double& r = fit.residual[i];
      const bool kept = rows.bound[i] && r > 0;
      if (kept) r = 0;
      fit.influence[i] = kept ? 0 : rows.weight[i] / (1 + r * r / (4 * spread));
    }
  }
  // r^2 / scale^2 near 0, and the logarithm of it far out.
  for (Eigen::Index i = 0; i < fit.residual.size(); ++i)
    fit.cost += each * rows.weight[i] * 4 * std::log1p(fit.residual[i] * fit.residual[i] / (4 * spread));
  return fit;
}

double robust_scale(const RobustRows& rows, const Eigen::VectorXd& residual) {
  std::vector<std::pair<double, double>> sizes;
  double all = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (rows.bound[i] || !(rows.weight[i] > 0)) continue;
    sizes.emplace_back(std::abs(residual[i]), rows.weight[i]);
    all += rows.weight[i];
  }
  std::sort(sizes.begin(), sizes.end());
  double median = 0;
  double below = 0;
  for (const auto& [size, weight] : sizes) {
    median = size;
    below += weight;
    if (below >= 0.5 * all) break;
  }
  return std::max({1.48 * median, kLeastScale * mean_size(rows), 1e-300});
}

double independent_rows(const RobustRows& rows, const Eigen::VectorXd& residual, const Eigen::MatrixX3f& normals) {
  const Eigen::Index n = residual.size();
  const Eigen::VectorXd weight = rows.bound.select(0.0, rows.weight);
  const Eigen::VectorXd held =
      weight.cwiseProduct(residual.cwiseMax(-kMostScales * rows.scale).cwiseMin(kMostScales * rows.scale));
  std::array<float, kDistanceBins> least{};
  for (int k = 0; k < kDistanceBins; ++k)
    least[static_cast<std::size_t>(k)] = static_cast<float>(std::cos(radians(kBinDeg * (k + 1))));
  std::array<double, kDistanceBins> products{};
  std::array<double, kDistanceBins> weights{};
  for (Eigen::Index i = 1; i < n; ++i) {
    const Eigen::VectorXf cosines = normals.topRows(i) * normals.row(i).transpose();
    for (Eigen::Index j = 0; j < i; ++j) {
      if (cosines[j] < least.back()) continue;
      std::size_t bin = 0;
      while (cosines[j] < least[bin]) ++bin;
      products[bin] += 2 * held[i] * held[j];
      weights[bin] += 2 * weight[i] * weight[j];
    }
  }
  double own = 0;  // of a row with itself
  for (Eigen::Index i = 0; i < n; ++i) own += weight[i] > 0 ? held[i] * held[i] / weight[i] : 0;
  const double sum = weight.sum();
  const double variance = own / std::max(1e-300, sum);
  double alike = weight.squaredNorm();
  for (std::size_t bin = 0; bin < kDistanceBins && variance > 0; ++bin) {
    if (products[bin] < 0) break;
    alike += products[bin] / variance;
  }
  return alike > 0 ? sum * sum / alike : 1;
}

}  // namespace faceprobe::lighting

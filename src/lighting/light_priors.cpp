#include "lighting/light_priors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace faceprobe::lighting {
namespace {

constexpr double kEdgeScale = 0.1;  // of log luminance between neighbours: below, steps count as noise, above, as edges
constexpr double kBin = 0.25;       // of log luminance; also the width of a cell's Gaussian
constexpr int kBinReach = 4;        // bins to each side that a cell reaches
constexpr double kMostLog = 30;     // u is taken as no more than this from 0 in the histogram

constexpr int kBins = 2 * static_cast<int>(kMostLog / kBin) + 2 * kBinReach + 2;

// The bins around a value: the first one's number, and the shares that it gets.
struct Spread {
  int first = 0;
  double offset = 0;  // of the value from the first bin, in bins
  std::array<double, 2 * kBinReach + 1> share{};
};

Spread spread_of(double value) {
  const double place = (std::clamp(value, -kMostLog, kMostLog) + kMostLog) / kBin + kBinReach;
  Spread spread;
  spread.first = static_cast<int>(std::lround(place)) - kBinReach;
  spread.offset = place - spread.first;
  for (std::size_t k = 0; k < spread.share.size(); ++k) {
    const double away = spread.offset - static_cast<double>(k);
    spread.share[k] = std::numbers::inv_sqrtpi / std::numbers::sqrt2 * std::exp(-0.5 * away * away);
  }
  return spread;
}

}  // namespace

std::vector<std::pair<int, int>> neighbours(const SphereGrid& grid) {
  // Between the spacing along rings and columns and that across.
  const auto least = static_cast<float>(std::cos(1.3 * std::sqrt(grid.cell_solid_angle())));
  std::vector<std::pair<int, int>> edges;
  for (int a = 0; a < grid.cell_count(); ++a) {
    const Eigen::VectorXf cosine = grid.directions() * grid.direction(a);
    for (int b = a + 1; b < grid.cell_count(); ++b) {
      if (cosine[b] > least) edges.emplace_back(a, b);
    }
  }
  return edges;
}

double gradient_prior(const std::vector<std::pair<int, int>>& edges, const Eigen::VectorXd& u, double weight,
                      Eigen::VectorXd& gradient) {
  double sum = 0;
  for (const auto& [a, b] : edges) {
    const double step = u[a] - u[b];
    const double spread = kEdgeScale * kEdgeScale + step * step;
    sum += std::log(spread / (kEdgeScale * kEdgeScale));
    const double slope = weight * 2 * step / spread;
    gradient[a] += slope;
    gradient[b] -= slope;
  }
  return sum;
}

double entropy_prior(const Eigen::VectorXd& u, double weight, Eigen::VectorXd& gradient) {
  const auto count = static_cast<double>(u.size());
  std::vector<Spread> spreads;
  std::array<double, kBins> histogram{};
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    const Spread& spread = spreads.emplace_back(spread_of(u[j]));
    for (std::size_t k = 0; k < spread.share.size(); ++k)
      histogram[static_cast<std::size_t>(spread.first) + k] += spread.share[k] / count;
  }
  double entropy = 0;
  std::array<double, kBins> slope{};  // of the entropy by a bin's share
  for (std::size_t k = 0; k < histogram.size(); ++k) {
    if (!(histogram[k] > 0)) continue;
    entropy -= histogram[k] * std::log(histogram[k]);
    slope[k] = -std::log(histogram[k]) - 1;
  }
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    if (std::abs(u[j]) > kMostLog) continue;
    const Spread& spread = spreads[static_cast<std::size_t>(j)];
    double sum = 0;
    for (std::size_t k = 0; k < spread.share.size(); ++k)
      sum -= slope[static_cast<std::size_t>(spread.first) + k] * spread.share[k] *
             (spread.offset - static_cast<double>(k));
    gradient[j] += weight * sum / kBin;  // of count cells with a share of 1 / count each
  }
  return count * entropy;
}

}  // namespace faceprobe::lighting

#include "lighting/compact_fit.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/quantile.h"
#include "lighting/glow.h"
#include "lighting/robust_rows.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

constexpr Eigen::Index kFewestPatches = 50;
// In twice the log likelihood.
constexpr double kVeryStrong = 10;      // over the map as it is
constexpr double kStrong = 6;           // over wide discs
constexpr double kAlike = 1;            // of such widths the narrowest is taken: lamps and suns are narrow
constexpr double kRefinedWidthDeg = 5;  // of the disc that its place is refined with
constexpr int kRefinedParts = 7;
constexpr int kSteps = 5;           // of Gauss-Newton
constexpr double kProbeRad = 0.02;  // of the differences that slopes are taken from
constexpr double kLongestStepRad = 0.12;
constexpr double kShortestStepRad = 0.002;
constexpr int kRowsAtOnce = 64;  // rows of one product: the same rounding for any number of threads

struct Disc {
  double width_deg;
  int parts;  // 0: summed over the grid's cells
};
constexpr int kCompactDiscs = 4;
constexpr std::array<Disc, 7> kDiscs = {{{0.5, 1}, {5, 7}, {10, 19}, {20, 37}, {35, 0}, {50, 0}, {70, 0}}};

// What the light adds per unit of irradiance, #patches each.
struct Column {
  Eigen::VectorXd highlight, shading;
};

Eigen::MatrixXd seen_through(const Eigen::Ref<const RowMatrix>& transport, const Eigen::MatrixXf& cells, int threads) {
  Eigen::MatrixXf rows(transport.rows(), cells.cols());
  const Eigen::Index blocks = (transport.rows() + kRowsAtOnce - 1) / kRowsAtOnce;
  parallel_for(static_cast<int>(blocks), threads, [&](int first, int last) {
    for (Eigen::Index b = first; b < last; ++b) {
      const Eigen::Index size = std::min<Eigen::Index>(kRowsAtOnce, transport.rows() - b * kRowsAtOnce);
      rows.middleRows(b * kRowsAtOnce, size).noalias() = transport.middleRows(b * kRowsAtOnce, size) * cells;
    }
  });
  return rows.cast<double>();
}

// The rows, and how discs are seen by them.
class Problem {
 public:
  Problem(const Observations& observations, const Transport& transport, bool use_highlights, const SphereGrid& grid,
          const SolveOptions& options)
      : observations_(observations), transport_(transport), grid_(grid), options_(options), highlights_(use_highlights) {
    kinds_.resize(use_highlights ? 2 : 1);  // shading first
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      RobustRows& rows = kinds_[k];
      rows.data = ((k == 0 ? observations.shading : observations.highlight) * kLuminanceWeights).cast<double>();
      rows.weight = observations.weight.cast<double>();
      rows.bound = observations.clipped.rowwise().any();
    }
  }

  const std::vector<RobustRows>& kinds() const { return kinds_; }
  const Eigen::VectorXd& of_kind(const Column& column, std::size_t kind) const {
    return kind == 0 ? column.shading : column.highlight;
  }

  // Takes the noise from what the map as it is leaves unexplained. Returns the cost of that map.
  double set_noise(const Eigen::MatrixXf& shapes) {
    double cost = 0;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      RobustRows& rows = kinds_[k];
      const Eigen::MatrixXd seen =
          seen_through(k == 0 ? transport_.diffuse() : transport_.highlight(), shapes, options_.threads);
      rows.surround = seen.leftCols<kSurround>();
      const Eigen::VectorXd glow = seen.col(kSurround);
      // Rough at first: a tenth of the data, and one row in five worth a row.
      rows.scale = 0.1 * std::sqrt(rows.weight.dot(rows.data.cwiseAbs2()) / rows.weight.sum());
      rows.independent = 0.2 * static_cast<double>(rows.data.size());
      RowsFit fit;
      for (int round = 0; round < 3; ++round) {
        fit = fit_rows(rows, glow);
        rows.scale = robust_scale(rows, fit.residual);
      }
      rows.independent = independent_rows(rows, fit_rows(rows, glow).residual, observations_.normal);
      cost += fit_rows(rows, glow).cost;
    }
    return cost;
  }

  void set_noise(const std::vector<RowsFit>& fits) {
    for (std::size_t k = 0; k < kinds_.size(); ++k) kinds_[k].scale = robust_scale(kinds_[k], fits[k].residual);
  }

  // Of several centres at once, which looks up each patch's horizon once.
  std::vector<Column> columns(const std::vector<Eigen::Vector3d>& centres, double width_deg, int parts) const {
    Eigen::MatrixX3f directions(parts * static_cast<Eigen::Index>(centres.size()), 3);
    for (std::size_t i = 0; i < centres.size(); ++i)
      directions.middleRows(parts * static_cast<Eigen::Index>(i), parts) = disc_directions(centres[i], width_deg, parts);
    const Transport seen = build_transport(observations_, directions, 1.0F / static_cast<float>(parts),
                                           options_.threads, options_.fresnel);
    std::vector<Column> out(centres.size());
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Eigen::Index at = parts * static_cast<Eigen::Index>(i);
      out[i] = {seen.highlight().middleCols(at, parts).rowwise().sum().cast<double>(),
                seen.diffuse().middleCols(at, parts).rowwise().sum().cast<double>()};
    }
    return out;
  }

  Column column(const Eigen::Vector3d& centre, const Disc& disc) const {
    return disc.parts > 0 ? columns({centre}, disc.width_deg, disc.parts).front() : wide_column(centre, disc.width_deg);
  }

  std::vector<RowsFit> fits(const Column& light) const {
    std::vector<RowsFit> out;
    for (std::size_t k = 0; k < kinds_.size(); ++k) out.push_back(fit_rows(kinds_[k], of_kind(light, k)));
    return out;
  }

 private:
  // Cells by how much of them lies in the disc, roughly.
  Column wide_column(const Eigen::Vector3d& centre, double width_deg) const {
    const Eigen::VectorXf angle = angles_deg(grid_, centre);
    const double spacing = degrees(std::sqrt(grid_.cell_solid_angle()));
    std::vector<int> cells;
    std::vector<float> share;
    double sum = 0;
    for (int j = 0; j < grid_.cell_count(); ++j) {
      const double inside = std::clamp((width_deg / 2 - static_cast<double>(angle[j])) / spacing + 0.5, 0.0, 1.0);
      if (inside <= 0) continue;
      cells.push_back(j);
      share.push_back(static_cast<float>(inside));
      sum += inside * grid_.cell_solid_angle();
    }
    const Eigen::Index n = observations_.count();
    Column out{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < cells.size(); ++k) {
        out.shading[i] += static_cast<double>(share[k] * transport_.diffuse()(i, cells[k])) / sum;
        if (highlights_) out.highlight[i] += static_cast<double>(share[k] * transport_.highlight()(i, cells[k])) / sum;
      }
    }
    return out;
  }

  const Observations& observations_;
  const Transport& transport_;
  const SphereGrid& grid_;
  const SolveOptions& options_;
  bool highlights_;
  std::vector<RobustRows> kinds_;
};

double cost_of(const std::vector<RowsFit>& fits) {
  double cost = 0;
  for (const RowsFit& fit : fits) cost += fit.cost;
  return cost;
}

// Gauss-Newton's step of the light's place, radians along the two ways that `beside` are seen, the other unknowns following along.
Eigen::Vector2d newton_step(const Problem& problem, const std::vector<RowsFit>& fits, const Column& here,
                            const std::array<Column, 2>& beside) {
  Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const RobustRows& rows = problem.kinds()[k];
    const RowsFit& fit = fits[k];
    const Eigen::VectorXd& light = problem.of_kind(here, k);
    Eigen::Matrix<double, Eigen::Dynamic, 2> slope(light.size(), 2);
    for (int axis = 0; axis < 2; ++axis)
      slope.col(axis) =
          (problem.of_kind(beside[static_cast<std::size_t>(axis)], k) - light) * (fit.x[kSurround] / kProbeRad);
    const double each = rows.independent / (rows.weight.sum() * rows.scale * rows.scale);
    const Eigen::VectorXd weight = each * fit.influence;
    Eigen::Matrix<double, Eigen::Dynamic, kUnknowns> columns(light.size(), kUnknowns);
    columns << rows.surround, light;
    for (int i = 0; i < kUnknowns; ++i) {
      if (!(fit.x[i] > 0)) columns.col(i).setZero();  // held at zero
    }
    UnknownsMatrix inner = columns.transpose() * weight.asDiagonal() * columns;
    inner.diagonal() += prior_precision();
    inner.diagonal().array() += 1e-9 * (1 + inner.trace());
    const Eigen::Matrix<double, kUnknowns, 2> across = columns.transpose() * weight.asDiagonal() * slope;
    h += slope.transpose() * weight.asDiagonal() * slope - across.transpose() * inner.ldlt().solve(across);
    g -= slope.transpose() * weight.cwiseProduct(fit.residual);
  }
  if (!(h.trace() > 0)) return Eigen::Vector2d::Zero();
  h.diagonal().array() += 1e-6 * h.trace();
  const Eigen::Vector2d step = h.ldlt().solve(g);
  const double length = step.norm();
  if (!std::isfinite(length)) return Eigen::Vector2d::Zero();
  return length > kLongestStepRad ? Eigen::Vector2d(step * (kLongestStepRad / length)) : step;
}

Eigen::Vector3d refined(const Problem& problem, Eigen::Vector3d towards) {
  const auto probes = [](const Eigen::Vector3d& d) {
    const Eigen::Vector3d u = d.unitOrthogonal();
    const Eigen::Vector3d v = d.cross(u);
    return std::vector<Eigen::Vector3d>{d, (d + kProbeRad * u).normalized(), (d + kProbeRad * v).normalized()};
  };
  const auto look = [&](const Eigen::Vector3d& d) {
    return problem.columns(probes(d), kRefinedWidthDeg, kRefinedParts);
  };
  std::vector<Column> columns = look(towards);
  std::vector<RowsFit> fits = problem.fits(columns[0]);
  for (int round = 0; round < kSteps; ++round) {
    const Eigen::Vector2d step = newton_step(problem, fits, columns[0], {columns[1], columns[2]});
    const Eigen::Vector3d u = towards.unitOrthogonal();
    const Eigen::Vector3d v = towards.cross(u);
    double went = 0;
    for (const double share : {1.0, 0.5, 0.25}) {
      const Eigen::Vector3d there = (towards + share * (step[0] * u + step[1] * v)).normalized();
      std::vector<Column> seen = look(there);
      std::vector<RowsFit> tried = problem.fits(seen[0]);
      if (!(cost_of(tried) < cost_of(fits))) continue;
      towards = there;
      columns = std::move(seen);
      fits = std::move(tried);
      went = share * step.norm();
      break;
    }
    if (went < kShortestStepRad) break;
  }
  return towards;
}

// Gives map and light their colours: in each channel the two that fit its shading, the surround's factor near 1.
CompactFit coloured(const Observations& observations, const Transport& transport, const Eigen::MatrixXf& shapes,
                    const Eigen::VectorXf& level, const Light& spread, const RowsFit& fit,
                    const Eigen::VectorXd& column, int threads) {
  constexpr double kMostChange = 1.25;
  const Eigen::VectorXf without = static_cast<float>(fit.x[0]) * shapes.col(0);
  const Eigen::VectorXf smooth = shapes.middleCols<kSurround - 1>(1) * fit.x.segment<kSurround - 1>(1).cast<float>();
  const float ambient = spread.ambient.dot(kLuminanceWeights);
  Eigen::RowVector3f colour = Eigen::RowVector3f::Ones();
  if (ambient > 0) colour = spread.ambient.transpose() / ambient;
  CompactFit out;
  out.surround.resize(level.size(), 3);
  for (Eigen::Index j = 0; j < level.size(); ++j) {
    const float kept = level[j] > 0 ? without[j] / level[j] : 0.0F;
    out.surround.row(j) = kept * spread.radiance.row(j) + smooth[j] * colour;
  }
  const int channels = observations.grey ? 1 : 3;
  const Eigen::MatrixXd seen = seen_through(transport.diffuse(), out.surround.leftCols(channels), threads);
  const Eigen::VectorXd& weight = fit.influence;
  const double own = column.dot(weight.cwiseProduct(column));
  for (int c = 0; c < channels; ++c) {
    const Eigen::VectorXd data = observations.shading.col(c).cast<double>();
    const Eigen::VectorXd around = seen.col(c);
    const double across = column.dot(weight.cwiseProduct(around));
    const double square = around.dot(weight.cwiseProduct(around));
    const double of_data = column.dot(weight.cwiseProduct(data));
    const double determinant = square * own - across * across;
    double factor = 1;
    if (determinant > 1e-9 * square * own)
      factor = (own * around.dot(weight.cwiseProduct(data)) - across * of_data) / determinant;
    factor = std::clamp(factor, 1 / kMostChange, kMostChange);
    out.surround.col(c) *= static_cast<float>(factor);
    out.light.irradiance[c] = own > 0 ? std::max(0.0, (of_data - factor * across) / own) : 0;
  }
  if (observations.grey) {
    out.surround.rightCols<2>() = out.surround.col(0).replicate<1, 2>();
    out.light.irradiance.setConstant(out.light.irradiance[0]);
  }
  return out;
}

}  // namespace

std::optional<CompactFit> fit_compact_light(const Observations& observations, const Transport& transport,
                                            bool use_highlights, const SphereGrid& grid, const Light& spread,
                                            const SolveOptions& options) {
  if (observations.count() < kFewestPatches || !(observations.weight.sum() > 0)) return std::nullopt;
  const Eigen::VectorXf level = spread.radiance * kLuminanceWeights;
  const float ambient = upper_median_of(std::vector<float>(level.begin(), level.end()));
  const std::optional<Glow> glow = find_glow(level, ambient, spread.confidence, grid);
  if (!glow) return std::nullopt;
  Problem problem(observations, transport, use_highlights, grid, options);
  const double as_it_is = problem.set_noise(glow->shapes);
  const Eigen::Vector3d towards = refined(problem, glow->towards);

  std::vector<Column> columns;
  std::vector<RowsFit> best;
  double compact = std::numeric_limits<double>::infinity();
  double wide = compact;
  for (std::size_t i = 0; i < kDiscs.size(); ++i) {
    columns.push_back(problem.column(towards, kDiscs[i]));
    std::vector<RowsFit> fits = problem.fits(columns.back());
    const double cost = cost_of(fits);
    if (i >= kCompactDiscs) {
      wide = std::min(wide, cost);
    } else if (cost < compact) {
      compact = cost;
      best = std::move(fits);
    }
  }
  if (!(as_it_is - compact >= kVeryStrong && wide - compact >= kStrong)) return std::nullopt;  // nor NaN

  // The glow's residual was too large a noise if the disc is right; its own tells widths apart better.
  problem.set_noise(best);
  std::vector<std::vector<RowsFit>> fits;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kCompactDiscs; ++i) {
    fits.push_back(problem.fits(columns[i]));
    least = std::min(least, cost_of(fits.back()));
  }
  std::size_t chosen = 0;
  while (cost_of(fits[chosen]) > least + kAlike) ++chosen;
  CompactFit fit = coloured(observations, transport, glow->shapes, level, spread, fits[chosen].front(),
                            columns[chosen].shading, options.threads);
  if (!(luminance(fit.light.irradiance.data()) > 0)) return std::nullopt;
  fit.light.direction = towards;
  fit.light.width_deg = kDiscs[chosen].width_deg;
  fit.light.evidence = as_it_is - compact;
  return fit;
}

}  // namespace faceprobe::lighting

#include "faceprobe/lighting/face_features.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

constexpr float kWidth = 0.14F;          // radians: half a cell's spacing
constexpr float kLeastCosine = 0.85F;    // four widths
constexpr float kEnoughWeight = 0.005F;  // of all patches: at this much a cell is half known

constexpr float kBrightestLight = 300;  // of the solved light, over the level

using Cells = Eigen::Matrix<float, kFeatureCells, 4, Eigen::RowMajor>;

const SphereGrid& feature_grid() {
  static const SphereGrid grid(kFeatureNside);
  return grid;
}

void add(const Eigen::RowVector3f& direction, const Eigen::RowVector3f& value, float weight, Cells& cells) {
  const Eigen::MatrixX3f& centres = feature_grid().directions();
  for (int j = 0; j < kFeatureCells; ++j) {
    const float cosine = centres.row(j).dot(direction);
    if (cosine < kLeastCosine) continue;
    const float angle = std::acos(std::min(1.0F, cosine)) / kWidth;
    const float share = weight * std::exp(-0.5F * angle * angle);
    cells.row(j).head<3>() += share * value;
    cells(j, 3) += share;
  }
}

void finish(float enough, float scale, Cells& cells) {
  for (int j = 0; j < kFeatureCells; ++j) {
    const float known = cells(j, 3) + enough;
    cells.row(j).head<3>() = (scale / known * cells.row(j).head<3>()).cwiseMax(0.0F).cwiseSqrt();
    cells(j, 3) /= known;
  }
}

const std::array<int, kFeatureCells>& mirror_table() {
  static const std::array<int, kFeatureCells> table = [] {
    std::array<int, kFeatureCells> cells{};
    for (int j = 0; j < kFeatureCells; ++j) {
      const Eigen::Vector3f centre = feature_grid().direction(j);
      cells[static_cast<std::size_t>(j)] = feature_grid().cell_of({-centre.x(), centre.y(), centre.z()});
    }
    return cells;
  }();
  return table;
}

// What the physics alone make of it, coarsely.
Eigen::VectorXf solved_features(const Observations& observations, const Eigen::MatrixX3f& shading, float level) {
  Observations open = observations;
  open.horizon.resize(0, kHorizonAzimuths);
  open.shading = shading;
  open.open_shading.resize(0, 3);
  const SolveOptions options{.nside = 8, .iterations = 30, .compact_light = false, .threads = 1};
  const Eigen::MatrixX3f light = solve_transport(open, options).radiance / level;
  Eigen::Matrix<float, kFeatureCells, 3, Eigen::RowMajor> cells =
      grid_from_grid(light, SphereGrid(options.nside), feature_grid());
  cells = cells.cwiseMax(0.0F).cwiseMin(kBrightestLight).cwiseSqrt();
  return Eigen::Map<const Eigen::VectorXf>(cells.data(), cells.size());
}

}  // namespace

float shading_level(const Observations& observations) {
  double sum = 0;
  double weight = 0;
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    if (observations.clipped.row(i).any()) continue;
    const auto w = static_cast<double>(observations.weight[i]);
    sum += w * static_cast<double>(observations.shading.row(i).dot(kLuminanceWeights.transpose()));
    weight += w;
  }
  return weight > 0 ? static_cast<float>(sum / weight) : 0.0F;
}

Eigen::VectorXf face_features(const Observations& observations) {
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  Eigen::VectorXf features = Eigen::VectorXf::Zero(kFaceFeatures);
  const float level = shading_level(observations);
  if (!(level > 0)) return features;
  const bool has_open = observations.open_shading.rows() > 0;
  const Eigen::MatrixX3f& open_shading = has_open ? observations.open_shading : observations.shading;
  Cells shading = Cells::Zero();
  Cells highlight = Cells::Zero();
  Cells open = Cells::Zero();
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    const Eigen::RowVector3f normal = observations.normal.row(i);
    const Eigen::RowVector3f view = observations.view.row(i);
    const float weight = observations.weight[i];
    if (!observations.clipped.row(i).any()) add(normal, observations.shading.row(i) / level, weight, shading);
    if (has_open || !observations.clipped.row(i).any()) add(normal, open_shading.row(i) / level, weight, open);
    // A clipped highlight says that it is at least so bright.
    add(2 * normal.dot(view) * normal - view, observations.highlight.row(i) / level, weight, highlight);
  }
  const float enough = kEnoughWeight * observations.weight.sum();
  finish(enough, 1, shading);
  finish(enough, kHighlightScale, highlight);
  finish(enough, 1, open);
  Eigen::Index at = 0;
  for (const Cells* cells : {&shading, &highlight, &open}) {
    features.segment(at, cells->size()) = Eigen::Map<const Eigen::VectorXf>(cells->data(), cells->size());
    at += cells->size();
  }
  for (const Eigen::MatrixX3f* layer : {&observations.shading, &open_shading}) {
    const Eigen::VectorXf solved = solved_features(observations, *layer, level);
    features.segment(at, solved.size()) = solved;
    at += solved.size();
  }
  return features;
}

Eigen::MatrixXf mirrored_cells(const Eigen::MatrixXf& cells) {
  if (cells.rows() != kFeatureCells) throw std::invalid_argument("Mirroring needs one row a cell.");
  Eigen::MatrixXf out(cells.rows(), cells.cols());
  for (int j = 0; j < kFeatureCells; ++j) out.row(j) = cells.row(mirror_table()[static_cast<std::size_t>(j)]);
  return out;
}

Eigen::VectorXf mirrored_features(const Eigen::VectorXf& features) {
  if (features.size() != kFaceFeatures) throw std::invalid_argument("Mirroring needs all features.");
  Eigen::VectorXf out(kFaceFeatures);
  // Blocks of so many numbers a cell.
  const auto turn = [&](int begin, int numbers) {
    for (int j = 0; j < kFeatureCells; ++j) {
      const int from = mirror_table()[static_cast<std::size_t>(j)];
      out.segment(begin + numbers * j, numbers) = features.segment(begin + numbers * from, numbers);
    }
  };
  for (int layer = 0; layer < kGatheredLayers; ++layer) turn(4 * layer * kFeatureCells, 4);
  for (int light = 0; light < kSolvedLights; ++light) turn(kCellFeatures + 3 * light * kFeatureCells, 3);
  return out;
}

}  // namespace faceprobe::lighting

#include "faceprobe/lighting/radiance_transfer.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/albedo.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::lighting {
namespace {

constexpr float kLeastKnown = 0.02F;     // of a highlight, to be looked up
constexpr double kLeastVariance = 1e-4;  // a hundredth of the level: as well as intensities can be measured

using Terms = Eigen::Matrix<double, kTransferTerms, 1>;
using Square = Eigen::Matrix<double, kTransferTerms, kTransferTerms>;

double grey_of(const Eigen::RowVector3f& rgb) { return static_cast<double>(luminance(rgb[0], rgb[1], rgb[2])); }

// Of each point where its highlight is, and the harmonics there.
struct Points {
  SphereGrid grid{kFeatureNside};
  std::vector<SphereGrid::Interpolation> mirrored;                 // of the normal, seen from +z
  Eigen::Matrix<double, kFeatureCells, kTransferTerms> harmonics;  // times the cells' solid angle

  Points() {
    for (int j = 0; j < kFeatureCells; ++j) {
      const Eigen::Vector3f normal = grid.direction(j);
      mirrored.push_back(grid.interpolate(2 * normal.z() * normal - Eigen::Vector3f::UnitZ()));
      harmonics.row(j) = grid.cell_solid_angle() * sh::basis(2, normal.cast<double>()).transpose();
    }
  }
};

const Points& points() {
  static const Points known;
  return known;
}

}  // namespace

Eigen::MatrixX4f point_intensities(const Eigen::VectorXf& features) {
  if (features.size() != kFaceFeatures) throw std::invalid_argument("Intensities need all features of a face.");
  using Cells = Eigen::Map<const Eigen::Matrix<float, kFeatureCells, 4, Eigen::RowMajor>>;
  const Cells shading(features.data());
  const Cells highlight(features.data() + kCellFeatures / 2);
  Eigen::MatrixX4f out = Eigen::MatrixX4f::Zero(kFeatureCells, 4);
  for (int j = 0; j < kFeatureCells; ++j) {
    const float known = shading(j, 3);
    if (!(known > 0)) continue;
    // Features are the square roots of what is known of the light.
    Eigen::RowVector3f intensity = shading.row(j).head<3>().array().square().matrix() / known;
    const SphereGrid::Interpolation& place = points().mirrored[static_cast<std::size_t>(j)];
    Eigen::RowVector3f mirrored = Eigen::RowVector3f::Zero();
    float seen = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      mirrored += place.weight[k] * highlight.row(place.cell[k]).head<3>().array().square().matrix();
      seen += place.weight[k] * highlight(place.cell[k], 3);
    }
    if (seen > kLeastKnown) intensity += mirrored / (seen * kHighlightScale * kSkinLuminance);
    out.row(j) << intensity, known;
  }
  return out;
}

RadianceTransfer::RadianceTransfer(Eigen::MatrixXd transfer, Eigen::VectorXd variance)
    : transfer_(std::move(transfer)), variance_(std::move(variance)) {
  if (transfer_.rows() != kFeatureCells || transfer_.cols() != kTransferTerms || variance_.size() != kFeatureCells)
    throw std::invalid_argument("A radiance transfer has nine numbers and a variance for each cell of the features.");
  if (!transfer_.allFinite() || !variance_.allFinite() || !(variance_.minCoeff() > 0))
    throw std::invalid_argument("A radiance transfer must be finite, its variances above 0.");
}

Eigen::MatrixX3d RadianceTransfer::solve(const Eigen::VectorXf& features, double ridge) const {
  if (!(ridge > 0)) throw std::invalid_argument("The ridge must be above 0.");
  const Eigen::MatrixX4d intensities = point_intensities(features).cast<double>();
  const Eigen::VectorXd weight = intensities.col(3).cwiseQuotient(variance_);
  if (!(weight.sum() > 0)) return Eigen::MatrixX3d::Zero(kTransferTerms, 3);
  const Eigen::MatrixXd weighted = (weight / weight.sum()).asDiagonal() * transfer_;
  const Eigen::MatrixX3d right = weighted.transpose() * intensities.leftCols<3>();
  Eigen::MatrixXd products = weighted.transpose() * transfer_;
  products.diagonal().array() += ridge;
  return products.ldlt().solve(right);
}

RadianceTransferLearner::RadianceTransferLearner()
    : products_(Eigen::MatrixXd::Zero(kFeatureCells, kTransferTerms * kTransferTerms)),
      right_(Eigen::MatrixXd::Zero(kFeatureCells, kTransferTerms)), energy_(Eigen::VectorXd::Zero(kFeatureCells)),
      weight_(Eigen::VectorXd::Zero(kFeatureCells)) {}

void RadianceTransferLearner::add(const Eigen::VectorXf& features, const Eigen::MatrixX3f& light) {
  if (light.rows() != kFeatureCells)
    throw std::invalid_argument("The light to learn from must be on the features' cells.");
  add_once(point_intensities(features), light);
  add_once(point_intensities(mirrored_features(features)), mirrored_cells(light));
  ++examples_;
}

void RadianceTransferLearner::add_once(const Eigen::MatrixX4f& intensities, const Eigen::MatrixX3f& light) {
  Terms coefficients = Terms::Zero();
  for (int j = 0; j < kFeatureCells; ++j) coefficients += grey_of(light.row(j)) * points().harmonics.row(j).transpose();
  // A photo has no scale of its own. Over the face's brightness, light from behind is huge, and a few such photos would outvote all others: each
  // counts as if its light had the energy 1.
  const double energy = coefficients.squaredNorm();
  if (!(energy > 0)) return;
  const Square square = coefficients * coefficients.transpose();
  for (int j = 0; j < kFeatureCells; ++j) {
    const double weight = static_cast<double>(intensities(j, 3)) / energy;
    if (!(weight > 0)) continue;
    const double intensity = grey_of(intensities.row(j).head<3>());
    products_.row(j) += weight * square.reshaped().transpose();
    right_.row(j) += weight * intensity * coefficients.transpose();
    energy_[j] += weight * intensity * intensity;
    weight_[j] += weight;
  }
}

RadianceTransfer RadianceTransferLearner::learn(double ridge) const {
  if (!(ridge > 0)) throw std::invalid_argument("The ridge must be above 0.");
  Eigen::MatrixXd transfer(kFeatureCells, kTransferTerms);
  Eigen::VectorXd variance = Eigen::VectorXd::Ones(kFeatureCells);
  for (int j = 0; j < kFeatureCells; ++j) {
    const Square square = products_.row(j).reshaped(kTransferTerms, kTransferTerms);
    const Terms right = right_.row(j).transpose();
    const Terms found = (square + ridge * Square::Identity()).ldlt().solve(right);
    transfer.row(j) = found.transpose();
    if (weight_[j] > 0) {
      const double left = energy_[j] - 2 * found.dot(right) + found.dot(square * found);
      variance[j] = std::max(kLeastVariance, left / weight_[j]);
    }
  }
  return {std::move(transfer), std::move(variance)};
}

}  // namespace faceprobe::lighting

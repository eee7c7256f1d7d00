#include "lighting/glow.h"

#include "faceprobe/core/angles.h"
#include "lighting/robust_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::lighting {

namespace {

constexpr double kLeastContrast = 1.5;  // of a light's middle over the map's median, as in MainLightOptions
constexpr float kLeastConfidence = 0.3F;
constexpr int kPlaceDirections = 4;  // nside of the directions that the dominant light is looked for in
constexpr double kPlaceWidthDeg = 12;
constexpr double kCentreDeg = 25;  // around the light's middle, where its centroid is taken
constexpr double kRingDeg = 5;
constexpr int kFirstRing = 3;       // a glow ends not before 15 degrees
constexpr int kLastRing = 12;       // and by 60
constexpr double kFlattest = 0.97;  // of a ring to the one inside it: the glow ends where it hardly falls
constexpr double kGlowEnd = 0.05;   // or at this share of its height

// The direction around which most light above the median comes from, of what was seen.
Eigen::Vector3d dominant_direction(const Eigen::VectorXf& above, const Eigen::VectorXf& level, const SphereGrid& grid) {
  const SphereGrid places(kPlaceDirections);
  const auto variance = static_cast<float>(radians(kPlaceWidthDeg) * radians(kPlaceWidthDeg));
  const auto least = static_cast<float>(std::cos(radians(3 * kPlaceWidthDeg)));
  int best = 0;
  double most = -1;
  for (int place = 0; place < places.cell_count(); ++place) {
    const Eigen::VectorXf cosines = grid.directions() * places.direction(place);
    double sum = 0;
    for (Eigen::Index j = 0; j < cosines.size(); ++j) {
      if (cosines[j] > least && above[j] > 0)
        sum += static_cast<double>(above[j] * std::exp((cosines[j] - 1.0F) / variance));
    }
    if (sum <= most) continue;
    most = sum;
    best = place;
  }
  Eigen::Vector3d towards = places.direction(best).cast<double>();
  const double nearby = std::cos(radians(kCentreDeg));
  for (int round = 0; round < 4; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < grid.cell_count(); ++j) {
      const Eigen::Vector3d d = grid.direction(j).cast<double>();
      // Weighed by the level too, as in main_lights(): a lopsided glow does not move the centre.
      if (d.dot(towards) > nearby) sum += static_cast<double>(above[j] * level[j]) * d;
    }
    if (!(sum.norm() > 0)) break;
    towards = sum.normalized();
  }
  return towards;
}

// `rim`: luminance where the glow ends.
Eigen::MatrixXf shapes_of(const Eigen::VectorXf& angle, double radius_deg, double rim, const Eigen::VectorXf& level,
                          float ambient, const SphereGrid& grid) {
  Eigen::MatrixXf shapes(grid.cell_count(), kUnknowns);
  shapes.col(0) = level;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (static_cast<double>(angle[j]) < radius_deg) shapes(j, 0) = std::min(level[j], static_cast<float>(rim));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::ArrayXf along = grid.directions().col(axis).array();
    shapes.col(1 + 2 * axis) = ambient * (0.5F * (1.0F + along)).square();
    shapes.col(2 + 2 * axis) = ambient * (0.5F * (1.0F - along)).square();
  }
  shapes.col(kSurround) = level - shapes.col(0);
  return shapes;
}

}  // namespace

Eigen::VectorXf angles_deg(const SphereGrid& grid, const Eigen::Vector3d& towards) {
  const Eigen::VectorXf cosines = grid.directions() * towards.cast<float>();
  return cosines.unaryExpr([](float c) { return static_cast<float>(degrees(std::acos(std::clamp(c, -1.0F, 1.0F)))); });
}

std::optional<Glow> find_glow(const Eigen::VectorXf& level, float ambient, const Eigen::VectorXf& confidence,
                              const SphereGrid& grid) {
  Eigen::VectorXf above = (level.array() - ambient).max(0.0F);
  for (Eigen::Index j = 0; j < above.size(); ++j) {
    if (confidence[j] < kLeastConfidence) above[j] = 0;
  }
  if (!(above.maxCoeff() > 0)) return std::nullopt;
  const Eigen::Vector3d towards = dominant_direction(above, level, grid);
  const Eigen::VectorXf angle = angles_deg(grid, towards);
  std::array<double, kLastRing + 2> sum{};
  std::array<int, kLastRing + 2> count{};
  for (int j = 0; j < grid.cell_count(); ++j) {
    const auto ring = static_cast<std::size_t>(static_cast<double>(angle[j]) / kRingDeg);
    if (ring >= sum.size()) continue;
    sum[ring] += static_cast<double>(level[j]);
    ++count[ring];
  }
  std::array<double, kLastRing + 2> mean{};
  double inside = static_cast<double>(level[grid.cell_of(towards.cast<float>())]);
  for (std::size_t ring = 0; ring < mean.size(); ++ring) {  // rings of a coarse grid may be empty
    if (count[ring] > 0) inside = sum[ring] / count[ring];
    mean[ring] = inside;
  }
  const auto median = static_cast<double>(ambient);
  if (mean[0] < kLeastContrast * median) return std::nullopt;
  std::size_t end = kFirstRing;
  while (end < kLastRing && mean[end + 1] < kFlattest * mean[end] && mean[end] > median + kGlowEnd * (mean[0] - median))
    ++end;
  return Glow{towards, shapes_of(angle, kRingDeg * static_cast<double>(end), mean[end], level, ambient, grid)};
}

}  // namespace faceprobe::lighting

#include "faceprobe/lighting/sky.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace faceprobe::lighting {
namespace {

constexpr double kSunReachDeg = 8;      // all of a sun that is spread over cells, and of its glare
constexpr double kAwayFromSunDeg = 12;  // of the cells that are sky and nothing else
constexpr double kAboveHorizon = 0.05;  // height of a direction there
constexpr double kGamma = 1 / 2.2;      // the compression in which skies are compared
constexpr double kUsualMiss = 0.2;      // of compressed light over its mean: cells farther off count less
constexpr int kFitRounds = 8;           // of weights and exposure
constexpr double kCoarseStep = 0.5;     // of turbidity
constexpr double kFineStep = 1e-3;

double cell_luminance(const Eigen::MatrixX3f& radiance, Eigen::Index cell) {
  return static_cast<double>(luminance(radiance(cell, 0), radiance(cell, 1), radiance(cell, 2)));
}

void check_radiance(const Eigen::MatrixX3f& radiance, const SphereGrid& grid) {
  if (radiance.rows() != grid.cell_count()) {
    throw std::invalid_argument("fit_sky: there must be " + std::to_string(grid.cell_count()) + " cells, not " +
                                std::to_string(radiance.rows()));
  }
  if (!radiance.allFinite() || radiance.minCoeff() < 0)
    throw std::invalid_argument("fit_sky: a cell's radiance is negative or no number");
}

// Where the brightest place above the horizon has its middle.
Eigen::Vector3d brightest_place(const Eigen::MatrixX3f& radiance, const SphereGrid& grid) {
  int peak = -1;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).y() < 0) continue;
    if (peak < 0 || cell_luminance(radiance, j) > cell_luminance(radiance, peak)) peak = j;
  }
  if (!(cell_luminance(radiance, peak) > 0))
    throw std::invalid_argument("fit_sky: there is no light above the horizon");
  const Eigen::Vector3d towards = grid.direction(peak).cast<double>();
  // What stands out from the ring around it; of a grid whose cells are wider than that the one cell.
  double ring = 0;
  for (int j = 0; j < grid.cell_count(); ++j) {
    const double away = angle_between_deg(towards, grid.direction(j).cast<double>());
    if (away > kSunReachDeg && away < kAwayFromSunDeg) ring = std::max(ring, cell_luminance(radiance, j));
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < grid.cell_count(); ++j) {
    const Eigen::Vector3d direction = grid.direction(j).cast<double>();
    if (angle_between_deg(towards, direction) > kSunReachDeg) continue;
    sum += std::max(0.0, cell_luminance(radiance, j) - ring) * direction;
  }
  return sum.norm() > 0 ? sum.normalized() : towards;
}

// How well skies of one sun and many turbidities agree with a map.
class SkyMatch {
 public:
  struct Result {
    double cost = 0;
    double exposure = 1;
    double misfit = 0;
  };

  SkyMatch(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const SkyParameters& sun)
      : grid_(grid), sky_(sun) {
    const Eigen::Vector3d towards = sun_direction(sun);
    for (int j = 0; j < grid.cell_count(); ++j) {
      const Eigen::Vector3d direction = grid.direction(j).cast<double>();
      if (direction.y() > kAboveHorizon && angle_between_deg(towards, direction) > kAwayFromSunDeg) cells_.push_back(j);
    }
    seen_ = compressed(radiance);
    level_ = seen_.mean();
    if (!(level_ > 0)) throw std::invalid_argument("fit_sky: there is no light above the horizon but the sun's");
  }

  Result at(double turbidity) const {
    SkyParameters sky = sky_;
    sky.turbidity = turbidity;
    sky.exposure = 1;
    sky.sun = 0;
    const Eigen::MatrixX3d model = compressed(sky_radiance(sky, grid_));
    Eigen::ArrayXd weight = Eigen::ArrayXd::Ones(seen_.rows());
    Result result;
    for (int round = 0; round < kFitRounds; ++round) {
      const double gain = (model.cwiseProduct(seen_).rowwise().sum().array() * weight).sum() /
                          (model.rowwise().squaredNorm().array() * weight).sum();
      const Eigen::ArrayXd miss = (seen_ - gain * model).rowwise().squaredNorm().array() / (3 * level_ * level_);
      const Eigen::ArrayXd over = 1 + miss / (kUsualMiss * kUsualMiss);
      result.cost = over.log().mean();  // Cauchy's
      result.exposure = std::pow(gain, 1 / kGamma);
      result.misfit = std::sqrt((miss * weight).sum() / weight.sum());
      weight = 1 / over;
    }
    return result;
  }

 private:
  Eigen::MatrixX3d compressed(const Eigen::MatrixX3f& radiance) const {
    Eigen::MatrixX3d out(static_cast<Eigen::Index>(cells_.size()), 3);
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      out.row(i) = radiance.row(cells_[static_cast<std::size_t>(i)]).cast<double>().array().pow(kGamma);
    return out;
  }

  const SphereGrid& grid_;
  SkyParameters sky_;
  std::vector<int> cells_;
  Eigen::MatrixX3d seen_;
  double level_ = 0;
};

double best_turbidity(const SkyMatch& match) {
  double best = SkyParameters::kLeastTurbidity;
  double least = match.at(best).cost;
  for (double t = best + kCoarseStep; t <= SkyParameters::kMostTurbidity; t += kCoarseStep) {
    const double cost = match.at(t).cost;
    if (cost < least) {
      least = cost;
      best = t;
    }
  }
  // Golden section between the neighbours.
  constexpr double kGolden = 0.6180339887498949;
  double low = std::max(SkyParameters::kLeastTurbidity, best - kCoarseStep);
  double high = std::min(SkyParameters::kMostTurbidity, best + kCoarseStep);
  while (high - low > kFineStep) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (match.at(left).cost < match.at(right).cost) {
      high = right;
    } else {
      low = left;
    }
  }
  return (low + high) / 2;
}

double sum_of_luminance(const Eigen::Vector3d& rgb) { return rgb.dot(luminance_weights<double>()); }

// The light around the sun that the sky does not account for, over what a clear sky's sun sends.
double share_of_sun(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, SkyParameters sky) {
  sky.sun = 0;
  const Eigen::MatrixX3f dome = sky_radiance(sky, grid);
  const Eigen::Vector3d towards = sun_direction(sky);
  double excess = 0;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (angle_between_deg(towards, grid.direction(j).cast<double>()) > kSunReachDeg) continue;
    excess += grid.cell_solid_angle() * (cell_luminance(radiance, j) - cell_luminance(dome, j));
  }
  sky.sun = 1;
  return std::clamp(excess / sum_of_luminance(sun_irradiance(sky)), 0.0, SkyParameters::kMostSun);
}

double albedo_of_ground(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, SkyParameters sky) {
  sky.ground_albedo = 1;
  const Eigen::MatrixX3f white = sky_radiance(sky, grid);
  double seen = 0;
  double most = 0;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (static_cast<double>(grid.direction(j).y()) > -kAboveHorizon) continue;
    if (angle_between_deg(sun_direction(sky), grid.direction(j).cast<double>()) < kAwayFromSunDeg) continue;
    seen += cell_luminance(radiance, j);
    most += cell_luminance(white, j);
  }
  return most > 0 ? std::clamp(seen / most, 0.0, 1.0) : 0;
}

}  // namespace

SkyFit fit_sky(const Eigen::MatrixX3f& radiance, const SphereGrid& grid) {
  check_radiance(radiance, grid);
  const Eigen::Vector3d sun = brightest_place(radiance, grid);
  SkyFit fit;
  fit.sky.sun_azimuth_deg = azimuth_deg(sun);
  fit.sky.sun_elevation_deg = std::clamp(elevation_deg(sun), 0.0, 90.0);
  const SkyMatch match(radiance, grid, fit.sky);
  fit.sky.turbidity = best_turbidity(match);
  const SkyMatch::Result best = match.at(fit.sky.turbidity);
  fit.sky.exposure = best.exposure;
  fit.misfit = best.misfit;
  fit.sky.sun = share_of_sun(radiance, grid, fit.sky);
  fit.sky.ground_albedo = albedo_of_ground(radiance, grid, fit.sky);
  return fit;
}

}  // namespace faceprobe::lighting

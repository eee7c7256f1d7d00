#include "paper/light_direction.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace faceprobe::cli {

namespace {

constexpr double kNoAgreement = std::numeric_limits<double>::quiet_NaN();

SphereGrid grid_of(const lighting::Light& light) { return SphereGrid::of_cells(light.radiance.rows()); }

std::optional<Eigen::Vector3d> unit(const Eigen::Vector3d& sum) {
  if (!(sum.norm() > 1e-9)) return std::nullopt;
  return sum.normalized();
}

}  // namespace

Eigen::VectorXd luminances(const lighting::Light& light) {
  Eigen::VectorXd values(light.radiance.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = luminance(light.radiance(i, 0), light.radiance(i, 1), light.radiance(i, 2));
  }
  return values;
}

pipeline::LightResult result_of(Eigen::MatrixX3f radiance, const Eigen::VectorXf& confidence) {
  pipeline::LightResult result;
  result.light.radiance = std::move(radiance);
  result.lights = lighting::main_lights(result.light.radiance, grid_of(result.light), {}, confidence);
  return result;
}

std::vector<Eigen::Vector3d> light_directions(const pipeline::LightResult& result) {
  std::vector<Eigen::Vector3d> directions;
  for (const lighting::MainLight& light : result.lights) directions.push_back(light.direction);
  if (!directions.empty()) return directions;
  const Eigen::VectorXd values = luminances(result.light);
  if (lighting::is_even(values)) return {};
  Eigen::Index brightest = 0;
  values.maxCoeff(&brightest);
  return {grid_of(result.light).direction(static_cast<int>(brightest)).cast<double>()};
}

std::optional<Eigen::Vector3d> energy_centroid(const pipeline::LightResult& result) {
  const Eigen::VectorXd values = luminances(result.light);
  if (lighting::is_even(values)) return std::nullopt;
  std::vector<double> sorted(values.begin(), values.end());
  std::nth_element(sorted.begin(), sorted.begin() + values.size() / 2, sorted.end());
  const double middle = sorted[static_cast<std::size_t>(values.size() / 2)];
  const SphereGrid grid = grid_of(result.light);
  return unit(grid.directions().cast<double>().transpose() * (values.array() - middle).max(0.0).matrix());
}

std::optional<Eigen::Vector3d> single_lamp(const lighting::Observations& observations) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  Eigen::Vector3d lit = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    if (observations.clipped.row(i).any()) continue;
    const Eigen::Vector3d normal = observations.normal.row(i).transpose().cast<double>();
    const double weight = observations.weight[i];
    moment += weight * normal * normal.transpose();
    lit += weight * normal *
           static_cast<double>(
               luminance(observations.shading(i, 0), observations.shading(i, 1), observations.shading(i, 2)));
  }
  return unit(moment.ldlt().solve(lit));
}

std::optional<Eigen::Vector3d> mean_direction(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : directions) sum += direction;
  return unit(sum);
}

double nearest_deg(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& candidates) {
  double nearest = 180;
  for (const Eigen::Vector3d& candidate : candidates)
    nearest = std::min(nearest, angle_between_deg(direction, candidate));
  return nearest;
}

std::vector<double> agreement_with_others(const Eigen::MatrixXd& maps, const std::vector<int>& person) {
  Eigen::MatrixXd unit_maps = maps.rowwise() - maps.colwise().mean();
  for (Eigen::Index i = 0; i < maps.cols(); ++i) {
    const bool even = lighting::is_even(maps.col(i));
    unit_maps.col(i) = even ? Eigen::VectorXd::Constant(maps.rows(), kNoAgreement) : unit_maps.col(i).normalized();
  }
  const Eigen::MatrixXd correlation = unit_maps.transpose() * unit_maps;
  std::vector<double> means;
  for (Eigen::Index i = 0; i < maps.cols(); ++i) {
    double sum = 0;
    int others = 0;
    for (Eigen::Index j = 0; j < maps.cols(); ++j) {
      if (person[static_cast<std::size_t>(i)] == person[static_cast<std::size_t>(j)]) continue;
      if (std::isnan(correlation(i, j))) continue;
      sum += correlation(i, j);
      ++others;
    }
    means.push_back(others > 0 ? sum / others : kNoAgreement);
  }
  return means;
}

}  // namespace faceprobe::cli

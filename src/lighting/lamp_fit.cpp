#include "lighting/lamp_fit.h"

#include "faceprobe/core/angles.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace faceprobe::lighting {
namespace {

constexpr double kLeastMetres = 0.05;

struct Ray {
  Eigen::Vector3d from, towards;
  double position_error_m;
  double log_irradiance;
};

std::vector<Ray> rays_of(const std::vector<FaceLights>& faces, const std::vector<Sighting>& seen) {
  std::vector<Ray> rays;
  for (const Sighting& s : seen) {
    const FaceLights& face = faces[static_cast<std::size_t>(s.face)];
    const MainLight& light = face.lights[static_cast<std::size_t>(s.light)];
    rays.push_back(
        {face.position_m, light.direction, face.position_error_m, std::log(std::max(1e-12, light.irradiance))});
  }
  return rays;
}

// Variance of a direction as seen at a distance, radians squared.
double angular_variance(const Ray& ray, double distance_m, const TriangulateOptions& options) {
  const double own = radians(options.direction_error_deg);
  const double of_place = ray.position_error_m / distance_m;
  return own * own + of_place * of_place;
}

// What a larger variance costs: twice the logarithm of its normal distribution's spread over that of a distant lamp, which does not depend on the
// faces' places. Without it a near lamp would always explain more.
double spread_cost(double variance, const TriangulateOptions& options) {
  const double own = radians(options.direction_error_deg);
  return 2 * std::log(variance / (own * own));
}

// A face whose skin is lit by a lamp at d has irradiance I / d^2: the logarithms plus 2 log d should agree.
double strength_cost(const std::vector<Ray>& rays, const Eigen::VectorXd& log_distance, double error) {
  double mean = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    mean += (rays[i].log_irradiance + 2 * log_distance[static_cast<Eigen::Index>(i)]) / static_cast<double>(rays.size());
  double cost = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double off = rays[i].log_irradiance + 2 * log_distance[static_cast<Eigen::Index>(i)] - mean;
    cost += off * off / (error * error);
  }
  return cost;
}

double squared_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  return angle * angle;
}

// `variance`: of each ray's direction. It is held while the lamp moves, or the lamp would be drawn to where its misses count less.
double near_cost(const std::vector<Ray>& rays, const std::vector<double>& variance, const Eigen::Vector3d& position,
                 const TriangulateOptions& options) {
  double cost = 0;
  Eigen::VectorXd log_distance(static_cast<Eigen::Index>(rays.size()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d offset = position - rays[i].from;
    const double distance = std::max(kLeastMetres, offset.norm());
    log_distance[static_cast<Eigen::Index>(i)] = std::log(distance);
    cost += squared_angle(offset, rays[i].towards) / variance[i] + spread_cost(variance[i], options);
  }
  return cost + strength_cost(rays, log_distance, options.log_strength_error);
}

// Second derivatives of half the cost by differences: it is a function of three numbers.
Eigen::Matrix3d curvature(const std::vector<Ray>& rays, const std::vector<double>& variance, const Eigen::Vector3d& at,
                          double step, const TriangulateOptions& options) {
  Eigen::Matrix3d out;
  const auto cost = [&](double a, double b, int i, int j) {
    Eigen::Vector3d moved = at;
    moved[i] += a * step;
    moved[j] += b * step;
    return 0.5 * near_cost(rays, variance, moved, options);
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out(i, j) =
          i == j ? (cost(1, 0, i, j) - 2 * cost(0, 0, i, j) + cost(-1, 0, i, j)) / (step * step)
                 : (cost(1, 1, i, j) - cost(1, -1, i, j) - cost(-1, 1, i, j) + cost(-1, -1, i, j)) / (4 * step * step);
    }
  }
  return out;
}

Eigen::Vector3d slope(const std::vector<Ray>& rays, const std::vector<double>& variance, const Eigen::Vector3d& at,
                      double step, const TriangulateOptions& options) {
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(i);
    out[i] = 0.5 * (near_cost(rays, variance, at + move, options) - near_cost(rays, variance, at - move, options)) /
             (2 * step);
  }
  return out;
}

// Where the rays pass nearest to one another, each weighted by how far away that is (algebraic, a few rounds).
Eigen::Vector3d nearest_to_rays(const std::vector<Ray>& rays, const TriangulateOptions& options) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<double> distance(rays.size(), 2.0);
  constexpr int kRounds = 5;
  constexpr double kWeakPull = 1e-4;  // towards a point two metres along the rays, where they are parallel
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i];
      const double weight = 1 / (angular_variance(ray, distance[i], options) * distance[i] * distance[i]);
      const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray.towards * ray.towards.transpose();
      left += weight * (across + kWeakPull * Eigen::Matrix3d::Identity());
      right += weight * (across * ray.from + kWeakPull * (ray.from + 2 * ray.towards));
    }
    position = left.ldlt().solve(right);
    for (std::size_t i = 0; i < rays.size(); ++i)
      distance[i] = std::max(kLeastMetres, (position - rays[i].from).norm());
  }
  return position;
}

}  // namespace

LampFit fit_near_lamp(const std::vector<FaceLights>& faces, const std::vector<Sighting>& seen,
                      const TriangulateOptions& options) {
  const std::vector<Ray> rays = rays_of(faces, seen);
  constexpr double kStep_m = 1e-3;
  constexpr int kMostSteps = 60;
  LampFit fit;
  fit.near = true;
  fit.position_m = nearest_to_rays(rays, options);
  std::vector<double> variance;
  for (const Ray& ray : rays) {
    const double distance = std::max(kLeastMetres, (fit.position_m - ray.from).norm());
    variance.push_back(angular_variance(ray, distance, options));
  }
  fit.cost = near_cost(rays, variance, fit.position_m, options);
  // Levenberg and Marquardt's way between Newton's step and the slope's.
  double damping = 1e-2;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Matrix3d matrix = curvature(rays, variance, fit.position_m, kStep_m, options);
    const double size = std::max(1e-9, matrix.diagonal().cwiseAbs().maxCoeff());
    matrix.diagonal().array() += damping * size;
    const Eigen::Vector3d move = -matrix.ldlt().solve(slope(rays, variance, fit.position_m, kStep_m, options));
    const double cost = near_cost(rays, variance, fit.position_m + move, options);
    if (move.allFinite() && cost < fit.cost) {
      const double gain = fit.cost - cost;
      fit.position_m += move;
      fit.cost = cost;
      damping = std::max(1e-9, damping / 4);
      if (gain < 1e-9 * (1 + cost)) break;
    } else {
      damping *= 8;
      if (damping > 1e9) break;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(curvature(rays, variance, fit.position_m, kStep_m, options));
  // A direction in which the cost does not rise is not known: as uncertain as the room is large.
  const Eigen::Vector3d along = axes.eigenvalues().cwiseMax(1 / (options.most_m * options.most_m)).cwiseInverse();
  fit.covariance_m2 = axes.eigenvectors() * along.asDiagonal() * axes.eigenvectors().transpose();
  return fit;
}

LampFit fit_distant_lamp(const std::vector<FaceLights>& faces, const std::vector<Sighting>& seen,
                         const TriangulateOptions& options) {
  const std::vector<Ray> rays = rays_of(faces, seen);
  LampFit fit;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Ray& ray : rays) sum += ray.towards;
  fit.direction = sum.norm() > 0 ? sum.normalized() : rays.front().towards;
  const double variance = std::pow(radians(options.direction_error_deg), 2);
  for (const Ray& ray : rays) fit.cost += squared_angle(ray.towards, fit.direction) / variance;
  fit.cost +=
      strength_cost(rays, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rays.size())), options.log_strength_error);
  return fit;
}

}  // namespace faceprobe::lighting

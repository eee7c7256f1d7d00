#include "faceprobe/lighting/rate_main_lights.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "lighting/horizon_profile.h"
#include "lighting/skin_of.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace faceprobe::lighting {

namespace {

constexpr double kIndependentPatches = 20;  // ESTIMATE, see the header
constexpr double kLeastResidual = 0.01;     // exact data are no proof of exact normals
constexpr double kStepRad = 0.035;          // of the differences that stand for derivatives: 2 degrees
constexpr double kPi2 = kPi / 2;

// What light does on each patch: highlight rows, then shading rows, 2 x #patches.
class Patches {
 public:
  Patches(const Observations& observations, Fresnel fresnel) : seen_(observations), fresnel_(fresnel) {
    if (seen_.horizon.rows() == 0) return;
    profiles_.reserve(static_cast<std::size_t>(seen_.count()));
    for (Eigen::Index i = 0; i < seen_.count(); ++i) profiles_.push_back(horizon_profile(seen_.horizon.row(i)));
  }

  // Of a unit of irradiance from one direction, times `share`, added.
  void add(const Eigen::Vector3d& direction, double share, Eigen::VectorXd& rows) const {
    const Eigen::Vector3f towards = direction.cast<float>();
    const HorizonPlace place = horizon_place(towards);
    const Eigen::Index n = seen_.count();
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector3f normal = seen_.normal.row(i).transpose();
      const float cosine = normal.dot(towards);
      if (cosine <= 0) continue;
      const double visible =
          share * (profiles_.empty()
                       ? 1.0
                       : static_cast<double>(profile_visibility(profiles_[static_cast<std::size_t>(i)], place)));
      const Eigen::Vector3f view = seen_.view.row(i).transpose();
      rows[i] += visible * static_cast<double>(specular_lobe(normal, view, towards, skin_of(seen_, i, fresnel_)));
      rows[n + i] += visible * static_cast<double>(cosine) / kPi;
    }
  }

  // Of a unit of irradiance from an even disc. Seven points have its second moments.
  Eigen::VectorXd disc(const Eigen::Vector3d& middle, double solid_angle_sr) const {
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(2 * seen_.count());
    const double radius = std::min(kPi2, std::acos(std::clamp(1 - solid_angle_sr / (2 * kPi), -1.0, 1.0)));
    const double out = radius * std::sqrt(7.0 / 12);
    const Eigen::Vector3d u = middle.unitOrthogonal();
    const Eigen::Vector3d v = middle.cross(u);
    add(middle, 1.0 / 7, rows);
    for (int k = 0; k < 6; ++k) {
      const double angle = k * kPi / 3;
      add(std::cos(out) * middle + std::sin(out) * (std::cos(angle) * u + std::sin(angle) * v), 1.0 / 7, rows);
    }
    return rows;
  }

  // Of radiance 1 from everywhere.
  Eigen::VectorXd surround() const {
    Eigen::VectorXd rows = Eigen::VectorXd::Zero(2 * seen_.count());
    const SphereGrid sky(2);
    for (int j = 0; j < sky.cell_count(); ++j) add(sky.direction(j).cast<double>(), sky.cell_solid_angle(), rows);
    return rows;
  }

 private:
  const Observations& seen_;
  Fresnel fresnel_;
  std::vector<HorizonProfile> profiles_;
};

// By row what n w_k / (W s_k^2) is; empty where nothing is known of errors.
Eigen::VectorXd row_weights(const Observations& o, const Light& light) {
  Eigen::VectorXd weight = o.weight.cast<double>();
  for (Eigen::Index i = 0; i < o.count(); ++i) {
    if (o.clipped.row(i).any()) weight[i] = 0;
  }
  const double sum = weight.sum();
  if (!(sum > 0) || !(light.highlight_residual || light.shading_residual)) return {};
  const double independent = std::min(kIndependentPatches, sum * sum / weight.squaredNorm());
  const auto of = [&](const std::optional<double>& residual, const Eigen::VectorXf& data) -> Eigen::VectorXd {
    const double square = weight.dot(data.cast<double>().cwiseAbs2()) / sum;
    if (!residual || !(square > 0)) return Eigen::VectorXd::Zero(weight.size());
    const double deviation = std::max(kLeastResidual, *residual);
    return weight * (independent / (sum * deviation * deviation * square));
  };
  const Eigen::MatrixX3f highlight = (o.highlight - light.leak * o.shading).cwiseMax(0.0F) / light.highlight_gain;
  Eigen::VectorXd rows(2 * o.count());
  rows << of(light.highlight_residual, highlight * kLuminanceWeights),
      of(light.shading_residual, o.shading * kLuminanceWeights);
  return rows;
}

}  // namespace

void rate_main_lights(const Observations& observations, const Light& light, const SolveOptions& options,
                      std::vector<MainLight>& lights) {
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const SphereGrid grid(options.nside);
  if (light.confidence.size() != grid.cell_count())
    throw std::invalid_argument("Lights are rated by a confidence per cell of the solver's grid.");
  if (lights.empty() || observations.count() == 0) return;
  const Eigen::VectorXd weight = row_weights(observations, light);
  if (weight.size() == 0) return;
  const Patches patches(observations, options.fresnel);
  const auto count = static_cast<Eigen::Index>(lights.size());
  Eigen::MatrixXd jacobian(weight.size(), 3 * count + 1);
  for (Eigen::Index l = 0; l < count; ++l) {
    const MainLight& lamp = lights[static_cast<std::size_t>(l)];
    const float confidence = light.confidence[grid.cell_of(lamp.direction.cast<float>())];
    const double strength = lamp.irradiance * std::sqrt(std::clamp(static_cast<double>(confidence), 0.0, 1.0));
    jacobian.col(3 * l) = strength * patches.disc(lamp.direction, lamp.solid_angle_sr);
    const Eigen::Vector3d u = lamp.direction.unitOrthogonal();
    const Eigen::Vector3d ways[2] = {u, lamp.direction.cross(u)};
    for (int w = 0; w < 2; ++w) {
      const auto turned = [&](double angle) {
        return patches.disc(std::cos(angle) * lamp.direction + std::sin(angle) * ways[w], lamp.solid_angle_sr);
      };
      jacobian.col(3 * l + 1 + w) = strength * (turned(kStepRad) - turned(-kStepRad)) / (2 * kStepRad);
    }
  }
  const auto ambient = static_cast<double>(light.ambient.dot(kLuminanceWeights));
  jacobian.col(3 * count) = ambient * patches.surround();
  Eigen::MatrixXd information = jacobian.transpose() * weight.asDiagonal() * jacobian;
  information.diagonal().array() += 1;  // the priors
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  for (Eigen::Index l = 0; l < count; ++l) {
    MainLight& lamp = lights[static_cast<std::size_t>(l)];
    const Eigen::Index at = 3 * l;
    const double turn = covariance(at + 1, at + 1) + covariance(at + 2, at + 2) + grid.cell_solid_angle() / 6;
    lamp.direction_uncertainty_deg = degrees(std::sqrt(turn));
    lamp.irradiance_uncertainty = std::sqrt(covariance(at, at));
  }
}

}  // namespace faceprobe::lighting

#include "lighting/joint_objective.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/skin_reflectance.h"
#include "faceprobe/lighting/albedo.h"
#include "lighting/horizon_profile.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace faceprobe::lighting {
namespace {

constexpr double kLobeStep = 0.5;     // most that a step changes a logarithm of the lobe
constexpr double kUnlikeSkins = 0.3;  // ESTIMATE: standard deviation of both logarithms from person to person

}  // namespace

LobePrior skin_lobe_prior() {
  Eigen::Matrix<double, 2, kSkinRegionCount> lobes;
  for (int region = 0; region < kSkinRegionCount; ++region) {
    const auto [roughness, specular_albedo] = skin_reflectance(static_cast<Region>(region + 1));
    const auto m2 = static_cast<double>(roughness) * static_cast<double>(roughness);
    // The peak at normal incidence, and the exponent that falls as Beckmann's distribution does at a slope of m.
    const double kappa = static_cast<double>(specular_albedo * kSkinF0) / (kPi * m2);
    const double gamma = (1 - 2 * std::log1p(m2)) / (0.5 * std::log1p(m2));
    lobes.col(region) << std::log(kappa), std::log(gamma);
  }
  LobePrior prior;
  prior.mean = lobes.rowwise().mean();
  const Eigen::Matrix<double, 2, kSkinRegionCount> centred = lobes.colwise() - prior.mean;
  prior.covariance = centred * centred.transpose() / kSkinRegionCount;
  prior.covariance += kUnlikeSkins * kUnlikeSkins * Eigen::Matrix2d::Identity();
  return prior;
}

JointObjective::JointObjective(const Observations& observations, const JointOptions& options)
    : options_(options), prior_(skin_lobe_prior()), precision_(prior_.covariance.inverse()) {
  const SphereGrid grid(options.nside);
  edges_ = neighbours(grid);
  const auto all = static_cast<long long>(observations.count());
  const auto rows = static_cast<int>(std::min<long long>(all, options.most_rows));
  cosine_ = fresnel_ = log_half_ = Eigen::ArrayXXf::Zero(rows, grid.cell_count());
  appearance_.resize(rows, 4);
  weight_.resize(rows);
  clipped_.resize(static_cast<std::size_t>(rows));
  const bool shadowed = observations.horizon.rows() > 0;
  const std::vector<HorizonPlace> places = shadowed ? horizon_places(grid.directions()) : std::vector<HorizonPlace>();
  parallel_for(rows, options.threads, [&](int first, int last) {
    for (int row = first; row < last; ++row) {
      const auto i = static_cast<Eigen::Index>(row * all / rows);
      const Eigen::Vector3f normal = observations.normal.row(i).transpose();
      const Eigen::Vector3f view = observations.view.row(i).transpose();
      const Eigen::RowVector3f seen = kSkinLuminance * observations.shading.row(i) + observations.highlight.row(i);
      appearance_.row(row) << seen.cast<double>(), static_cast<double>(luminance(seen[0], seen[1], seen[2]));
      weight_[row] = static_cast<double>(observations.weight[i]);
      clipped_[static_cast<std::size_t>(row)] = observations.clipped.row(i).any() ? 1 : 0;
      HorizonProfile profile{};
      if (shadowed) profile = horizon_profile(observations.horizon.row(i));
      for (int j = 0; j < grid.cell_count(); ++j) {
        const Eigen::Vector3f light = grid.direction(j);
        const float cosine = normal.dot(light);
        if (cosine <= 0) continue;
        const Eigen::Vector3f half = (light + view).normalized();
        const float visible = shadowed ? profile_visibility(profile, places[static_cast<std::size_t>(j)]) : 1.0F;
        cosine_(row, j) = visible * cosine * static_cast<float>(grid.cell_solid_angle());
        fresnel_(row, j) = schlick_fresnel(view.dot(half), kSkinF0) / kSkinF0;
        log_half_(row, j) = std::log(std::clamp(normal.dot(half), 1e-4F, 1.0F));
      }
    }
  });
  const double mean = weight_.dot(appearance_.col(3)) / weight_.sum();
  level_ = mean / static_cast<double>(kSkinLuminance);
  if (mean > 0) appearance_ /= mean;
  weight_ *= rows / weight_.sum();
  set_lobe(prior_.mean);
}

Eigen::VectorXd JointObjective::plain_weight() const {
  Eigen::VectorXd plain = weight_;
  for (std::size_t i = 0; i < clipped_.size(); ++i) {
    if (clipped_[i] != 0) plain[static_cast<Eigen::Index>(i)] = 0;
  }
  return plain;
}

void JointObjective::set_lobe(const Eigen::Vector2d& lobe) {
  lobe_ = lobe;
  const auto kappa = static_cast<float>(std::exp(lobe[0]));
  const auto gamma = static_cast<float>(std::exp(lobe[1]));
  const float lambert = kSkinLuminance / static_cast<float>(kPi);
  transport_.resize(cosine_.rows(), cosine_.cols());
  for (Eigen::Index j = 0; j < cosine_.cols(); ++j) {
    const auto lobes = (kappa * fresnel_.col(j) * (gamma * log_half_.col(j)).exp()).exp() - 1.0F;
    transport_.col(j) = (cosine_.col(j) * (lambert + lobes) / kSkinLuminance).matrix().cast<double>();
  }
}

Eigen::VectorXd JointObjective::residual(const Eigen::VectorXd& light) const {
  Eigen::VectorXd left = transport_ * light - appearance_.col(3);
  // Clipped patches were at least so bright.
  for (std::size_t i = 0; i < clipped_.size(); ++i) {
    double& r = left[static_cast<Eigen::Index>(i)];
    if (clipped_[i] != 0) r = std::min(r, 0.0);
  }
  return left;
}

double JointObjective::misfit(const Eigen::VectorXd& residual) const {
  return 0.5 * weight_.dot(residual.cwiseAbs2()) / (options_.noise * options_.noise);
}

double JointObjective::lobe_energy() const {
  const Eigen::Vector2d away = lobe_ - prior_.mean;
  return 0.5 * away.dot(precision_ * away);
}

double JointObjective::value(const Eigen::VectorXd& u, double entropy, Eigen::VectorXd& gradient) const {
  const Eigen::VectorXd light = u.array().exp();
  const Eigen::VectorXd left = residual(light);
  const Eigen::VectorXd pull = weight_.cwiseProduct(left) / (options_.noise * options_.noise);
  gradient = (transport_.transpose() * pull).cwiseProduct(light);
  const double low = entropy * options_.entropy;
  double sum = misfit(left) + lobe_energy();
  if (options_.gradient > 0) sum += options_.gradient * gradient_prior(edges_, u, options_.gradient, gradient);
  if (low > 0) sum += low * entropy_prior(u, low, gradient);
  return sum;
}

void JointObjective::improve_lobe(const Eigen::VectorXd& u) {
  const Eigen::VectorXd light = u.array().exp();
  const Eigen::VectorXd left = residual(light);
  const double before = misfit(left) + lobe_energy();
  const Eigen::Vector2d from = lobe_;
  const auto kappa = static_cast<float>(std::exp(from[0]));
  const auto gamma = static_cast<float>(std::exp(from[1]));
  Eigen::MatrixX2d slope = Eigen::MatrixX2d::Zero(cosine_.rows(), 2);
  for (Eigen::Index j = 0; j < cosine_.cols(); ++j) {
    const Eigen::ArrayXf power = kappa * fresnel_.col(j) * (gamma * log_half_.col(j)).exp();
    const Eigen::ArrayXf by_kappa = cosine_.col(j) * power.exp() * power / kSkinLuminance;
    slope.col(0) += light[j] * by_kappa.matrix().cast<double>();
    slope.col(1) += light[j] * (by_kappa * gamma * log_half_.col(j)).matrix().cast<double>();
  }
  for (std::size_t i = 0; i < clipped_.size(); ++i) {
    if (clipped_[i] != 0 && left[static_cast<Eigen::Index>(i)] >= 0) slope.row(static_cast<Eigen::Index>(i)).setZero();
  }
  const double certainty = 1 / (options_.noise * options_.noise);
  const Eigen::Matrix2d curvature = certainty * slope.transpose() * weight_.asDiagonal() * slope + precision_;
  const Eigen::Vector2d downhill =
      -certainty * slope.transpose() * weight_.cwiseProduct(left) - precision_ * (from - prior_.mean);
  Eigen::Vector2d step = curvature.ldlt().solve(downhill);
  step *= std::min(1.0, kLobeStep / std::max(1e-12, step.cwiseAbs().maxCoeff()));
  for (int halving = 0; halving < 3; ++halving, step *= 0.5) {
    set_lobe(from + step);
    if (misfit(residual(light)) + lobe_energy() <= before) return;
  }
  set_lobe(from);
}

}  // namespace faceprobe::lighting

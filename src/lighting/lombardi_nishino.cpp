#include "faceprobe/lighting/lombardi_nishino.h"

#include "lighting/joint_objective.h"
#include "lighting/lbfgs.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

constexpr double kLongestStep = 1;  // of log luminance
constexpr int kColourSteps = 6;     // few keep the colour smooth over the sphere

// The luminance's light in the colours of the appearance: steps of Richardson and Lucy's for each channel, over the same steps for the luminance. A
// grey face gives grey.
Eigen::MatrixX3d in_seen_colours(const JointObjective& objective, const Eigen::VectorXd& light) {
  const Eigen::MatrixXd& transport = objective.transport();
  const Eigen::VectorXd weight = objective.plain_weight();
  const Eigen::VectorXd reach = (transport.transpose() * weight).cwiseMax(1e-12);
  Eigen::MatrixX4d found = light.replicate(1, 4);
  if (!(weight.sum() > 0)) return found.leftCols<3>();
  // Channels differ by a factor each first of all, wherever a cell lies.
  const Eigen::RowVector4d seen = (weight.transpose() * objective.appearance()).cwiseMax(1e-12);
  for (int c = 0; c < 4; ++c) found.col(c) *= seen[c] / seen[3];
  for (int step = 0; step < kColourSteps; ++step) {
    const Eigen::MatrixX4d predicted = (transport * found).cwiseMax(1e-12);
    const Eigen::MatrixX4d ratio = weight.asDiagonal() * objective.appearance().cwiseQuotient(predicted);
    const Eigen::MatrixX4d back = transport.transpose() * ratio;
    for (Eigen::Index j = 0; j < found.rows(); ++j) {
      if (reach[j] > 1e-9) found.row(j).array() *= back.row(j).array() / reach[j];
    }
  }
  Eigen::MatrixX3d out(light.size(), 3);
  for (int c = 0; c < 3; ++c) out.col(c) = light.cwiseProduct(found.col(c)).cwiseQuotient(found.col(3).cwiseMax(1e-12));
  return out;
}

}  // namespace

std::string JointOptions::validate() const {
  if (nside < 2 || nside > 16) return "nside must be from 2 to 16, found " + std::to_string(nside) + ".";
  if (most_rows < 10 || most_rows > 5000)
    return "most_rows must be from 10 to 5000, found " + std::to_string(most_rows) + ".";
  if (rounds < 1 || rounds > 50) return "rounds must be from 1 to 50, found " + std::to_string(rounds) + ".";
  if (steps < 1 || steps > 1000) return "steps must be from 1 to 1000, found " + std::to_string(steps) + ".";
  if (!(noise > 0) || !std::isfinite(noise)) return "noise must be above 0.";
  if (!(gradient >= 0) || !(entropy >= 0) || !std::isfinite(gradient) || !std::isfinite(entropy))
    return "The weights of the priors must be 0 or more.";
  return {};
}

JointEstimate solve_lombardi_nishino(const Observations& observations, const JointOptions& options) {
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  JointEstimate estimate;
  estimate.nside = options.nside;
  estimate.radiance = Eigen::MatrixX3f::Zero(SphereGrid(options.nside).cell_count(), 3);
  if (observations.count() == 0) return estimate;
  JointObjective objective(observations, options);
  if (!(objective.level() > 0)) return estimate;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(objective.cells());
  for (int round = 0; round < options.rounds; ++round) {
    // Without light yet every value is alike, which an entropy must not keep so.
    const double share = options.rounds == 1 ? 1.0 : static_cast<double>(round) / (options.rounds - 1);
    const auto f = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
      return objective.value(at, share, gradient);
    };
    estimate.objective = minimise_lbfgs(f, options.steps, kLongestStep, u);
    if (round + 1 < options.rounds) objective.improve_lobe(u);
  }
  estimate.lobe = {.kappa = std::exp(objective.lobe()[0]), .gamma = std::exp(objective.lobe()[1])};
  estimate.radiance = (objective.level() * in_seen_colours(objective, u.array().exp().matrix())).cast<float>();
  return estimate;
}

}  // namespace faceprobe::lighting

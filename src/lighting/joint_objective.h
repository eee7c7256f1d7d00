#pragma once
// Internal: minus the logarithm of the posterior of light and lobe (lombardi_nishino.h), and its gradients. Light is the logarithm u of each cell's
// luminance over the level that an even light would have.
//
//   E(u, lobe) = 1/2 sum_i w_i (p_i - y_i)^2 / noise^2 + gradient sum_edges log(1 + (u_a - u_b)^2 / s^2) + entropy #cells H(u)
//              + 1/2 (lobe - mean)' covariance^-1 (lobe - mean),    p = T(lobe) e^u
//
// H: light_priors.h.

#include "faceprobe/lighting/lombardi_nishino.h"
#include "lighting/light_priors.h"

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

// What does not change with the light.
class JointObjective {
 public:
  // Observations that validate, with some light, at most options.most_rows of which are used.
  JointObjective(const Observations& observations, const JointOptions& options);

  int cells() const { return static_cast<int>(cosine_.cols()); }
  double level() const { return level_; }  // radiance of the even light that u = 0 is
  const LobePrior& prior() const { return prior_; }

  // (log kappa, log gamma).
  void set_lobe(const Eigen::Vector2d& lobe);
  const Eigen::Vector2d& lobe() const { return lobe_; }
  // All terms; the gradient by u. `entropy`: share of the options' weight.
  double value(const Eigen::VectorXd& u, double entropy, Eigen::VectorXd& gradient) const;
  // One damped Gauss-Newton step of the lobe; keeps the lobe where that is no better.
  void improve_lobe(const Eigen::VectorXd& u);

  // The appearance's predicted part by cell, #rows x #cells, per unit of e^u; the rows' weights, 0 for clipped ones; red, green, blue, luminance.
  const Eigen::MatrixXd& transport() const { return transport_; }
  Eigen::VectorXd plain_weight() const;
  const Eigen::MatrixX4d& appearance() const { return appearance_; }

 private:
  double misfit(const Eigen::VectorXd& residual) const;
  Eigen::VectorXd residual(const Eigen::VectorXd& light) const;
  double lobe_energy() const;

  JointOptions options_;
  LobePrior prior_;
  Eigen::Matrix2d precision_;
  std::vector<std::pair<int, int>> edges_;
  // #rows x #cells: cosine times solid angle where light arrives, Fresnel term over that at normal incidence, logarithm of the half vector's cosine.
  Eigen::ArrayXXf cosine_, fresnel_, log_half_;
  Eigen::MatrixXd transport_;
  Eigen::MatrixX4d appearance_;  // over its mean luminance
  Eigen::VectorXd weight_;       // mean 1
  std::vector<char> clipped_;
  Eigen::Vector2d lobe_;
  double level_ = 0;
};

}  // namespace faceprobe::lighting

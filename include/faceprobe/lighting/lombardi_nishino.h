#pragma once
// Light and reflectance at once, the most likely pair (after Lombardi & Nishino 2016, "Reflectance and illumination recovery in the wild"): light is
// free on the sphere, but natural light is uneven in few places (a heavy-tailed prior of its gradients) and holds few different values (a prior of
// low entropy, because reflection raises it); the surface is a directional-statistics BRDF whose parameters have a normal prior.
//
// Lite: one lobe exp(kappa cos^gamma(half angle)) - 1 beside Lambert's constant, where theirs has several, with curves over the difference angle;
// here kappa alone grows, with Schlick's Fresnel term of skin. The prior of (log kappa, log gamma) comes from our table of skin
// (core/skin_reflectance.h), an ESTIMATE, where theirs comes from measured materials of all kinds. Entropy and gradients are of the logarithm of
// the luminance, the weights are ours, and the luminance's solution is given its colours afterwards.
//
//   const JointEstimate found = solve_lombardi_nishino(observations, {});
//   const Eigen::MatrixX3f light = grid_from_grid(found.radiance, SphereGrid(found.nside), grid);
//
// It does not separate: highlight and diffuse light go in as the sum that the photo showed (skin's usual albedo times shading, plus highlight).
// Skin's colour is divided out as the observations have it. Not for a face whose normals are poor: nothing here knows of their errors.

#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>
#include <string>

namespace faceprobe::lighting {

struct JointOptions {
  int nside = 8;         // of the light's sphere grid: 768 cells
  int most_rows = 500;   // observations used, spread evenly over what there is
  int rounds = 4;        // of light, then lobe; the entropy's weight grows over them
  int steps = 25;        // of the light's optimiser in each round
  double noise = 0.1;    // standard deviation of the appearance, over its mean: what texture and normals put in
  double gradient = 1;   // weight of the gradients' prior; 0 = none
  double entropy = 0.3;  // weight of the entropy's prior; 0 = none
  int threads = 0;       // 0 = all processors

  std::string validate() const;  // empty when usable, else which value is wrong
};

// The lobe: exp(kappa F cos^gamma) - 1, per steradian, F the Fresnel term over that at normal incidence.
struct SkinLobe {
  double kappa = 0, gamma = 0;  // its strength and its narrowness, both above 0
};
// Of (log kappa, log gamma).
struct LobePrior {
  Eigen::Vector2d mean;        // 2
  Eigen::Matrix2d covariance;  // 2 x 2
};
// What skin in general has: from the table of ten regions, and as wide again for what that does not hold.
LobePrior skin_lobe_prior();

struct JointEstimate {
  Eigen::MatrixX3f radiance;  // cells of `nside` x 3, linear Rec.709, in the observations' unit
  int nside = 0;
  SkinLobe lobe;
  double objective = 0;  // minus the logarithm of the posterior, up to a constant
};

// Black where there is no light or no observation. The same for any number of threads. Throws std::invalid_argument for observations or options that
// do not validate.
JointEstimate solve_lombardi_nishino(const Observations& observations, const JointOptions& options = {});

}  // namespace faceprobe::lighting

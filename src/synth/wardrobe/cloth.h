#pragma once
// Colours of cloth: plain, striped, checked, with the unevenness of weave.

#include "faceprobe/core/random.h"

#include <Eigen/Core>

namespace faceprobe::synth {

struct Cloth {
  enum class Pattern : std::uint8_t { kPlain, kStripes, kChecks } pattern = Pattern::kPlain;
  Eigen::Vector3f colour{0.2F, 0.2F, 0.2F};
  Eigen::Vector3f second{0.5F, 0.5F, 0.5F};
  float period_m = 0.03F;
  float weave = 0.08F;  // relative noise
  std::uint64_t seed = 0;

  // x: around or across, y: up; metres.
  Eigen::Vector3f at(const Eigen::Vector3f& p) const;
};

Cloth draw_cloth(Random& random, bool patterned);
// A colour that clothes are dyed in, linear.
Eigen::Vector3f draw_dye(Random& random);

}  // namespace faceprobe::synth

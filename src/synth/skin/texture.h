#pragma once
// Look-up in a prepared skin texture, in logarithms of linear light: deviations of skin are products of pigments, so they add up there,
// and a table of 256 logarithms saves taking them per point.

#include "faceprobe/synth/skin.h"

#include <Eigen/Core>

namespace faceprobe::synth {

struct TextureSample {
  Eigen::Vector3f log_linear;
  Eigen::Vector3f log_broad;  // broad deviation from the mean, part of log_linear
};

// uv in [0, 1]^2, v up; footprint_uv: width in the square of what is asked for, 0 = as fine as the texture.
TextureSample sample_texture(const SkinTexture& texture, const Eigen::Vector2f& uv, float footprint_uv);

}  // namespace faceprobe::synth

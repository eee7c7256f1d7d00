#pragma once
// core/microfacet.h's specular_lobe() with rho_s = 1 over whole arrays. The arguments are arrays or array expressions of one length:
// the cosines between normal, light and view, roughness and F0.

#include "faceprobe/core/angles.h"

#include <Eigen/Core>
#include <cmath>

namespace faceprobe::synth {

// A mirror rougher than this is as sharp as the cells can tell.
inline constexpr float kLeastRoughness = 0.01F;

template <class NL, class VL, class NV, class M, class F>
void lobe_values(const Eigen::ArrayBase<NL>& n_l, const Eigen::ArrayBase<VL>& v_l, const Eigen::ArrayBase<NV>& n_v,
                 const Eigen::ArrayBase<M>& roughness, const Eigen::ArrayBase<F>& f0, Eigen::ArrayXf& n_h,
                 Eigen::ArrayXf& v_h, Eigen::ArrayXf& out) {
  // |V + L|^2 = 2 + 2 V.L; where that is nothing the light is behind the surface and the result is 0 anyway.
  v_h = (0.5F + 0.5F * v_l).max(1e-6F).sqrt();
  n_h = ((n_l + n_v) / (2.0F * v_h)).max(1e-4F).min(1.0F);
  const auto m2 = roughness.square();
  const auto c2 = n_h.square();
  out = ((c2 - 1.0F) / (c2 * m2)).exp() / (m2 * c2.square());  // D
  out *= (2.0F * n_h * n_v.min(n_l).max(0.0F) / v_h).min(1.0F) /
         (static_cast<float>(kPi) * n_v.max(1e-6F));  // G / (pi N.V)
  n_h = (1.0F - v_h).square();
  out *= f0 + (1.0F - f0) * n_h.square() * (1.0F - v_h);  // F
}

}  // namespace faceprobe::synth

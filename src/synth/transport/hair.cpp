#include "synth/transport/hair.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr int kSteps = 64;

// Integral over the sphere of (-cos(theta_l + theta_v))+^p, by the midpoint rule in theta_l.
float lobe_integral(float theta_v, float exponent) {
  const float step = static_cast<float>(kPi) / kSteps;
  const Eigen::ArrayXf theta = (Eigen::ArrayXf::LinSpaced(kSteps, 0, kSteps - 1) + 0.5F) * step;
  const Eigen::ArrayXf lobe = (exponent * (-(theta + theta_v).cos()).max(1e-6F).log()).exp();
  return 2.0F * static_cast<float>(kPi) * step * (lobe * theta.sin()).sum();
}

}  // namespace

Strand make_strand(const Eigen::Vector3f& tangent, const Eigen::Vector3f& view, float roughness, float f0) {
  Strand strand{tangent, view, std::max(1.0F, phong_exponent(std::max(roughness, 0.05F))), 0, f0};
  const float theta_v = std::acos(std::clamp(tangent.dot(view), -1.0F, 1.0F));
  // Along the strand the cone closes to a point; the floor keeps a finite lobe there.
  strand.scale = 4.0F / std::max(lobe_integral(theta_v, strand.exponent), 0.02F);
  return strand;
}

void hair_values(const Strand& strand, const Eigen::MatrixX3f& to_light, Eigen::ArrayXf& diffuse,
                 Eigen::ArrayXf& specular) {
  const float t_v = strand.tangent.dot(strand.view);
  const float sin_v = std::sqrt(std::max(0.0F, 1.0F - t_v * t_v));
  const Eigen::ArrayXf t_l = (to_light * strand.tangent).array();
  const Eigen::ArrayXf v_h = (0.5F + 0.5F * (to_light * strand.view).array()).max(0.0F).sqrt();
  const Eigen::ArrayXf sin_l = (1.0F - t_l.square()).max(0.0F).sqrt();
  diffuse = sin_l / static_cast<float>(kPi * kPi);
  const auto cosine = (sin_l * sin_v - t_l * t_v).max(1e-6F);
  const auto fresnel = strand.f0 + (1.0F - strand.f0) * (1.0F - v_h).square().square() * (1.0F - v_h);
  specular = strand.scale * fresnel * (strand.exponent * cosine.log()).exp();
}

}  // namespace faceprobe::synth

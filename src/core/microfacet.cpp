#include "faceprobe/core/microfacet.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>

namespace faceprobe {

float schlick_fresnel(float cosine, float f0) {
  const float m = std::clamp(1.0F - cosine, 0.0F, 1.0F);
  const float m2 = m * m;
  return f0 + (1.0F - f0) * m2 * m2 * m;
}

float beckmann(float cosine, float roughness) {
  const float c2 = cosine * cosine;
  if (c2 < 1e-8F) return 0.0F;  // slopes beyond any surface
  const float m2 = roughness * roughness;
  return std::exp(-(1.0F - c2) / (c2 * m2)) / (m2 * c2 * c2);
}

float specular_lobe(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                    const Microfacet& surface) {
  const float n_l = normal.dot(light);
  const float n_v = normal.dot(view);
  if (n_l <= 0.0F || n_v <= 0.0F) return 0.0F;
  const Eigen::Vector3f sum = view + light;
  const float length = sum.norm();
  if (length < 1e-6F) return 0.0F;
  const float n_h = std::min(1.0F, normal.dot(sum) / length);
  const float v_h = view.dot(sum) / length;
  if (n_h <= 0.0F || v_h <= 0.0F) return 0.0F;
  // Cook & Torrance 1982, Eq. 4: blocking of light and of view by the same V-cavity.
  const float shadowing = std::min({1.0F, 2.0F * n_h * n_v / v_h, 2.0F * n_h * n_l / v_h});
  return surface.specular_albedo * schlick_fresnel(v_h, surface.f0) * beckmann(n_h, surface.roughness) * shadowing /
         (static_cast<float>(kPi) * n_v);
}

float phong_exponent(float roughness) {
  const float blinn = 2.0F / (roughness * roughness) - 2.0F;
  return blinn / 4.0F;
}

}  // namespace faceprobe

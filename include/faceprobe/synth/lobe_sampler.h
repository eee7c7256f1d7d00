#pragma once
// Draws directions of light in proportion to Beckmann's distribution of half vectors, for Monte Carlo integrals of
// core/microfacet.h's lobe: mean of specular_lobe / density over many draws = integral over the directions of light.
//
//   const Eigen::Vector3f light = sample_lobe(normal, view, 0.3F, random.uniform(), random.uniform());
//   const float density = lobe_density(normal, view, light, 0.3F);

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace faceprobe::synth {

// u, v in [0, 1). The result may lie below the surface, where the lobe is 0 and the density is not; a half vector that the viewer
// sees from behind gives the zero vector. All vectors of unit length.
inline Eigen::Vector3f sample_lobe(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, float roughness,
                                   double u, double v) {
  // The slopes of Beckmann's facets are normal: tan^2 of the angle to the normal is exponential with mean m^2.
  const float tan2 = -roughness * roughness * static_cast<float>(std::log1p(-u));
  const float cosine = 1.0F / std::sqrt(1.0F + tan2);
  const float sine = std::sqrt(tan2) * cosine;
  const auto phi = static_cast<float>(2.0 * kPi * v);
  const Eigen::Vector3f side = normal.unitOrthogonal();
  const Eigen::Vector3f half = cosine * normal + sine * (std::cos(phi) * side + std::sin(phi) * normal.cross(side));
  const float v_h = view.dot(half);
  if (v_h <= 0.0F) return Eigen::Vector3f::Zero();
  return (2.0F * v_h * half - view).normalized();
}

// Per steradian: half vectors have D cos / pi, and a turn of the half vector turns the light 4 (V.H) as much in solid angle.
inline float lobe_density(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                          float roughness) {
  const Eigen::Vector3f sum = view + light;
  const float length = sum.norm();
  if (length < 1e-6F) return 0.0F;
  const float n_h = normal.dot(sum) / length;
  const float v_h = view.dot(sum) / length;
  if (n_h <= 0.0F || v_h <= 0.0F) return 0.0F;
  return beckmann(n_h, roughness) * n_h / (static_cast<float>(kPi) * 4.0F * v_h);
}

}  // namespace faceprobe::synth

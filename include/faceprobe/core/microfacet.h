#pragma once
// A rough mirror: Torrance-Sparrow with Beckmann's slope distribution, Schlick's Fresnel term and the V-cavity shadowing of Cook &
// Torrance 1982, in the normalisation of Weyrich et al. 2006, whose skin statistics use it:
//
//   f(L, V) = rho_s F D G / (pi (N.L) (N.V)),   D = exp(-tan^2 d / m^2) / (m^2 cos^4 d),   d = angle(N, H).
//
// With rho_s = .25 this is the energy-conserving lobe of today's textbooks (D / pi there, 1 / 4 in front).
//
//   float f_times_cosine = specular_lobe(n, v, l, {.roughness = 0.3F, .specular_albedo = 0.18F});

#include <Eigen/Core>

namespace faceprobe {

// Normal-incidence reflectance of skin, index of refraction 1.4.
inline constexpr float kSkinF0 = 0.028F;

// As average skin has it, unless told otherwise.
struct Microfacet {
  float roughness = 0.3F;         // m, rms slope
  float specular_albedo = 0.18F;  // rho_s
  float f0 = kSkinF0;             // Fresnel reflectance at normal incidence; 1 for an ideal metal
};

// Fresnel reflectance at the cosine of the angle between light and half vector (Schlick 1994).
float schlick_fresnel(float cosine, float f0);
// D of the formula above; cosine = N.H in (0, 1].
float beckmann(float cosine, float roughness);
// f(L, V) (N.L), per steradian; 0 when light or viewer are behind the surface. All vectors of unit length.
float specular_lobe(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                    const Microfacet& surface);

// Phong exponent of the reflection vector's lobe (R . L)^alpha that has the width of a Beckmann lobe of roughness m:
// n = 2 / m^2 - 2 for the half vector, a quarter of it for the mirror direction.
float phong_exponent(float roughness);

}  // namespace faceprobe

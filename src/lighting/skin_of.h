#pragma once
// Internal: a patch's reflectance as core/microfacet.h takes it.

#include "faceprobe/core/microfacet.h"
#include "faceprobe/lighting/observations.h"
#include "faceprobe/lighting/transport.h"

namespace faceprobe::lighting {

inline Microfacet skin_of(const Observations& observations, Eigen::Index patch, Fresnel fresnel) {
  Microfacet skin{.roughness = observations.roughness[patch], .specular_albedo = observations.specular_albedo[patch]};
  if (fresnel == Fresnel::kConstant) {
    skin.specular_albedo *= skin.f0;
    skin.f0 = 1;  // Schlick's term is 1 at every angle then
  }
  return skin;
}

}  // namespace faceprobe::lighting

#pragma once
// Light on a strand (Kajiya & Kay 1989, "Rendering fur with three dimensional textures"): diffuse ~ sin(T, L), and a lobe around the
// cone that mirrors the viewer, cos^p. Both are scaled so that an open white sky gives a white strand 1: the diffuse part by
// 1 / pi^2, the lobe by its own integral; times 4 F as for rho_s = .25 in core/microfacet.h.

#include <Eigen/Core>

namespace faceprobe::synth {

struct Strand {
  Eigen::Vector3f tangent;
  Eigen::Vector3f view;
  float exponent = 5;  // p
  float scale = 1;     // 4 / integral of the lobe
  float f0 = 0.05F;
};
Strand make_strand(const Eigen::Vector3f& tangent, const Eigen::Vector3f& view, float roughness, float f0);

// Per steradian, for unit directions (#L x 3).
void hair_values(const Strand& strand, const Eigen::MatrixX3f& to_light, Eigen::ArrayXf& diffuse,
                 Eigen::ArrayXf& specular);

}  // namespace faceprobe::synth

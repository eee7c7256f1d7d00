#pragma once
// Direct light by brute force: every texel of every map, with a shadow ray each, at a few points of a few pixels. Slow, and exact
// but for texels taken as points. It shares no code with the renderer under test (own rays, own shadows), so it tells apart what
// differs between two renderers: the way light is summed, or the lobe.

#include "faceprobe/core/env_map.h"
#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/mesh.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace faceprobe::bench {

enum class Lobe : std::uint8_t {
  kDiffuse,  // Lambert, albedo 1
  kSkin,     // core/microfacet.h, rho_s = 1, F0 of skin
  kMetal,    // the same with rho_s = 1/4, F = 1: the V-cavity counterpart of kCycles
  kCycles,   // Beckmann with Smith's shadowing, no Fresnel term (Walter et al. 2007)
};
inline constexpr int kLobeCount = 4;

struct QuadratureOptions {
  float roughness = 0.3F;
  int samples_per_side = 3;  // points per pixel and side
  int threads = 0;
};

// radiance[lobe]: #pixels x (3 #maps), red, green, blue of the first map, then of the second ...
struct Quadrature {
  std::array<Eigen::MatrixXf, kLobeCount> radiance;
};

// `pixels` (y * width + x) must lie inside the surface. Maps are in the camera's frame, all of one size.
Quadrature integrate_pixels(const synth::SurfaceMesh& mesh_cam, const synth::PinholeCamera& camera,
                            const std::vector<int>& pixels, std::span<const EnvMap> maps,
                            const QuadratureOptions& options);

// f (N.L) of kCycles, per steradian.
float beckmann_smith_lobe(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                          float alpha);

}  // namespace faceprobe::bench

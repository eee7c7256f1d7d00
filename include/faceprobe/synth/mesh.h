#pragma once
// What a scene is made of: triangle meshes and strands of hair, each with a plain material. Lengths in metres, in one frame per scene
// (the head's frame when there is one person: +x the subject's left, +y up, +z out of the face, origin midway between the eyes).
//
//   Figure thing;
//   thing.meshes.push_back({.material = Material::kObject, .vertices = vertices, .normals = normals, .triangles = triangles});

#include "faceprobe/core/region.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace faceprobe::synth {

enum class Material : std::uint8_t {
  kSkin = 0,  // albedo from a skin texture, subsurface blur, reflectance per region
  kEye,       // eyeball: smooth and wet
  kMouth,     // inside of the mouth, tongue, gums
  kTeeth,
  kHair,    // strands
  kFrame,   // glasses' frames
  kLens,    // glasses' lenses: let light and sight through, mirror a little (dielectric, both faces)
  kCloth,   // clothes, hats, scarves
  kObject,  // things in front of the face
};

// How a mesh other than skin answers light: Lambert's diffuse under the lobe of core/microfacet.h.
struct Reflectance {
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.5F);  // linear
  float roughness = 0.3F;                                    // m
  float specular_albedo = 0.18F;                             // rho_s
  float f0 = 0.04F;                                          // reflectance at normal incidence
};

struct SurfaceMesh {
  Material material = Material::kSkin;
  Reflectance reflectance;            // of a mesh that is not skin
  Eigen::MatrixX3f vertices;          // #V x 3, metres
  Eigen::MatrixX3f normals;           // #V x 3, unit length, outwards
  Eigen::MatrixX3i triangles;         // #T x 3, counter-clockwise seen from outside
  Eigen::MatrixX2f uv;                // #UV x 2, v up; may be empty
  Eigen::MatrixX3i triangle_uv;       // #T x 3 rows of uv; empty when uv is
  std::vector<Region> vertex_region;  // #V
  Eigen::MatrixX3f vertex_albedo;     // #V x 3, linear, in place of reflectance.albedo; may be empty
};

// Hair as curves of straight pieces.
struct Strands {
  Reflectance reflectance;  // albedo = colour of the hair; the lobe is along the strand (Kajiya & Kay 1989)
  Region region = Region::kHair;
  Eigen::MatrixX4f points;  // #P x (x, y, z, radius), metres
  std::vector<int> first_point;  // #strands + 1: strand s has the points first_point[s] .. first_point[s + 1] - 1, at least 2
  std::vector<float> tone;  // #strands: factor on the albedo, about 1
};

// Everything that belongs to one person (or thing), in the scene's frame.
struct Figure {
  std::vector<SurfaceMesh> meshes;
  std::vector<Strands> strands;
};

}  // namespace faceprobe::synth

#pragma once
// A pyramid with an open base, its tip towards +z, whose +x face has vertices of its own at the common edges (as a file with texture seams has).
// Two of its faces are skin, one is an eye, the open base is not covered.

#include "faceprobe/synth/head_model.h"

namespace faceprobe::synth {

inline HeadModel small_head() {
  HeadModel model;
  model.name = "pyramid";
  model.neutral.resize(7, 3);
  model.neutral << 0, 0, 1,  // 0 tip
      1, -1, 0,              // 1
      1, 1, 0,               // 2
      -1, 1, 0,              // 3
      -1, -1, 0,             // 4
      0, 0, 1,               // 5 the tip again
      1, 1, 0;               // 6 corner 2 again
  model.triangles.resize(4, 3);
  model.triangles << 0, 1, 2,  // +x
      5, 6, 3,                 // +y, over the seam
      5, 3, 4,                 // -x
      5, 4, 1;                 // -y, the eye
  model.triangle_material = {Material::kSkin, Material::kSkin, Material::kSkin, Material::kEye};
  model.vertex_region.assign(7, Region::kCheeks);
  model.vertex_region[4] = Region::kNose;
  model.uv.resize(5, 2);
  model.uv << 0, 0, 0.25F, 0, 0.5F, 0, 0.75F, 0, 1, 1;
  model.triangle_uv.resize(4, 3);
  model.triangle_uv << 4, 0, 1, 4, 1, 2, 4, 2, 3, 3, 2, 1;
  model.identity = {Eigen::MatrixX3f::Constant(7, 3, 0.25F), Eigen::MatrixX3f::Constant(2, 3, -0.5F)};
  model.expression = {Eigen::MatrixX3f::Constant(7, 3, 0.125F)};
  model.expression_names = {"jawOpen"};
  return model;
}

}  // namespace faceprobe::synth

#pragma once
// A thing to be drawn: triangle meshes and their materials, +y up, front towards +z.
//
//   Model model = pot();                                        // render/shapes.h; or assets::load_model("thing.glb").model
//   place(model, {.height_m = 0.2F, .foot_m = {0.1F, -0.15F, -0.6F}});

#include "faceprobe/render/material.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace faceprobe::render {

// One index per corner for position, normal and texture point alike.
struct TriangleMesh {
  Eigen::MatrixX3f vertices;   // #V x 3
  Eigen::MatrixX3f normals;    // #V x 3, unit length, outwards
  Eigen::MatrixX2f uv;         // #V x 2, v up; empty when there are none
  Eigen::MatrixX3i triangles;  // #T x 3, counter-clockwise seen from outside
  int material = 0;            // index into Model::materials
};

struct Model {
  std::vector<TriangleMesh> meshes;
  std::vector<Material> materials;

  int triangle_count() const;  // of all meshes
  // Of all vertices; empty when there are none.
  Eigen::AlignedBox3f box() const;
  // Empty when it can be drawn: indices in range, finite numbers, at least one triangle, materials that validate.
  std::string validate() const;
};

// Every vertex and normal by an affine map without a flat side; a mirroring one turns the triangles round.
void transform(Model& model, const Eigen::Transform<float, 3, Eigen::Affine>& world_from_model);

// Scales the model to a size and stands it somewhere.
struct Placement {
  float height_m = 0.2F;                             // of its box
  Eigen::Vector3f foot_m = Eigen::Vector3f::Zero();  // where the middle of the box's underside goes
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();     // where its +y goes
  float turn = 0;  // radians about up, positive to the viewer's right seen from the front
};
// Throws std::invalid_argument for a model without height, a height that is not above 0, and an `up` without length.
void place(Model& model, const Placement& placement);

}  // namespace faceprobe::render

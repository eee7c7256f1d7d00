#pragma once
// The transport matrices of a face: how much of the radiance in each cell of the sphere arrives in each observation.
//
//   highlight_i = sum_j S_ij e_j      S_ij = f(L_j, V_i) (N_i.L_j) visible_ij d_omega
//   shading_i   = sum_j D_ij e_j      D_ij = (N_i.L_j) visible_ij d_omega / pi
//
// Nothing is warped: every pixel keeps its own normal, view vector, roughness, Fresnel term and horizon. Rows of the open shading
// (Observations::open_shading) are D with visible = 1.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>
#include <cstdint>

namespace faceprobe::lighting {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Both matrices in one block of memory, as a solver takes them: it reads all of it in every step, and a copy costs as much as several steps.
struct Transport {
  RowMatrix rows;  // S, then D: 2 #patches x #cells

  Eigen::Index patches() const { return rows.rows() / 2; }
  auto highlight() const { return rows.topRows(patches()); }   // S, #patches x #cells; a view
  auto diffuse() const { return rows.bottomRows(patches()); }  // D, #patches x #cells; a view
};

// Schlick's, or as at normal incidence everywhere, as the paper's lobes are: to measure what the term is worth.
enum class Fresnel : std::uint8_t { kSchlick, kConstant };

// What D predicts: the shading with the face's own shadows, or the shading with nothing in the light's way.
enum class DiffuseRows : std::uint8_t { kShading, kOpenShading };

// Both at once, which halves the visibility tests. Throws std::invalid_argument for observations that do not validate.
Transport build_transport(const Observations& observations, const SphereGrid& grid, int threads = 0,
                          Fresnel fresnel = Fresnel::kSchlick, DiffuseRows diffuse = DiffuseRows::kShading);
// The same of lights anywhere. `directions`: #lights x 3, unit, from the face to the light; each has the same solid angle, in steradians, and is
// small beside what skin can tell apart. #patches x #lights.
Transport build_transport(const Observations& observations, const Eigen::MatrixX3f& directions, float solid_angle_sr,
                          int threads = 0, Fresnel fresnel = Fresnel::kSchlick,
                          DiffuseRows diffuse = DiffuseRows::kShading);

}  // namespace faceprobe::lighting

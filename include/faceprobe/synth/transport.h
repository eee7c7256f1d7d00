#pragma once
// Light transport of a scene as matrices: direct light is linear in the map, so what a fragment sends to the camera is a row times the
// map's cells, and hundreds of maps are one matrix product. Small bright lights (LightSample::distant, near) are traced per fragment.
//
// Diffuse rows belong to vertices and do not depend on the camera: one SceneTransport serves every view and every map.
// Specular rows belong to a view's fragments. Nothing depends on skin colour or specular albedo: those multiply afterwards.
//
// Not for: indirect specular light, caustics, participating media.
//
//   const SceneTransport scene_transport = build_scene_transport(scene, vertices_seen({&seen}), {});
//   const ViewTransport view = build_view_transport(scene, scene_transport, seen, camera_position, reflectance, {});
//   const std::vector<FragmentLight> light = shade(scene, scene_transport, view, samples, {});

#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/light_sample.h"
#include "faceprobe/synth/packed_rows.h"
#include "faceprobe/synth/scene.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::synth {

struct TransportOptions {
  int nside = 16;        // cells of core/sphere_grid.h
  int bounce_rays = 64;  // per vertex, for one diffuse bounce; 0 = none
  int threads = 0;       // 0 = all; the result does not depend on it
};

// What a scene does to light, whatever the view. Shading of row i that arrives over the bounce = bounce.row(i) * (albedo x shading of the rows). A
// row sums to at most the share of the white sky that its vertex does not see. A hit on a vertex without a row counts for the nearest vertex
// along the mesh that has one and faces a similar way, if it is near; other hits, such as on hair or on the inside of a mesh, are dropped.
struct SceneTransport {
  int nside = 16;
  std::vector<int> row_of_vertex;        // scene's vertices: row, or -1 where none was asked for
  PackedRows diffuse;                    // #rows x #cells: visibility (N.L)+ dOmega / pi; an open sky sums to 1
  std::vector<std::uint8_t> visibility;  // #rows x #cells: share of the cell that is seen, in 255ths; 0 below the surface
  Eigen::SparseMatrix<float, Eigen::RowMajor> bounce;  // #rows x #rows: shading gathered from radiosity of the other rows
};

// Vertices that the fragments of some views need (sorted, unique).
std::vector<int> vertices_seen(std::span<const Fragments* const> views);

// `vertices`: the scene's numbers. Throws std::invalid_argument for one that it does not have.
SceneTransport build_scene_transport(const Scene& scene, const std::vector<int>& vertices,
                                     const TransportOptions& options);

// Lobe of each fragment; `normal` may be rougher than the fragment's own (pores).
struct FragmentSurface {
  Eigen::MatrixX3f normal;    // #F x 3, scene frame, for the specular lobe
  Eigen::VectorXf roughness;  // #F, m
  Eigen::VectorXf f0;         // #F
};

struct ViewTransport {
  Fragments fragments;
  FragmentSurface surface;  // as given, but as rough as a pixel sees it: the bend of the surface within the pixel added
  Eigen::Vector3f camera_position;  // scene frame
  PackedRows specular;              // #F x #cells, for rho_s = 1, visibility included, cell's solid angle included
  std::vector<int> hair;            // fragments that are hair ...
  PackedRows hair_diffuse;  // ... and their rows: Kajiya & Kay's diffuse, energy-normalised so that white hair in a white furnace is <= 1
};
// `fragments`: of this scene, from find_fragments(); `camera_position`: scene frame, metres; `options`: the threads alone, as the cells are those
// of the transport. Throws std::invalid_argument when their arrays or the cells of the transport do not fit.
ViewTransport build_view_transport(const Scene& scene, const SceneTransport& transport, Fragments fragments,
                                   FragmentSurface surface, const Eigen::Vector3f& camera_position,
                                   const TransportOptions& options);

// What a map does to a view. Radiance = albedo * shading + specular_albedo * specular.
struct FragmentLight {
  Eigen::MatrixX3f shading;         // #F x 3: diffuse radiance of a white surface (irradiance / pi), direct
  Eigen::MatrixX3f specular;        // #F x 3: radiance of the lobe with rho_s = 1, direct
  Eigen::MatrixX3f vertex_shading;  // #rows of the scene transport x 3, for the bounce
};
struct ShadeOptions {
  int threads = 0;
  int near_light_samples = 16;  // points on each near lamp, 1 or more

  std::string validate() const;  // empty when usable, else which value is wrong
};
// One result per sample. The same bytes for any number of threads. Throws std::invalid_argument for another number of cells and options that do
// not validate.
std::vector<FragmentLight> shade(const Scene& scene, const SceneTransport& transport, const ViewTransport& view,
                                 std::span<const LightSample> samples, const ShadeOptions& options);

// Shading (#F x 3) that arrives over one diffuse bounce, from vertex_shading and the vertices' albedo (#rows x 3).
Eigen::MatrixX3f bounced_shading(const SceneTransport& transport, const ViewTransport& view,
                                 const Eigen::MatrixX3f& vertex_shading, const Eigen::MatrixX3f& vertex_albedo);

}  // namespace faceprobe::synth

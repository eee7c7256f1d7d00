#pragma once
// Places that small lights are traced for, as columns: the fragments of surfaces, the vertices of the rows, and the hairs of a view.

#include "faceprobe/synth/transport.h"
#include "synth/transport/hair.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace faceprobe::synth {

struct SurfacePoints {
  std::vector<int> index;   // fragment or row
  Eigen::MatrixX3f origin;  // of shadow rays: off the surface
  Eigen::MatrixX3f normal;
  Eigen::MatrixX3f lobe_normal;  // empty for vertices: they have no lobe
  Eigen::MatrixX3f view;
  Eigen::ArrayXf n_v;  // lobe_normal . view
  Eigen::ArrayXf roughness, f0;
  Eigen::MatrixX3i row;    // of the three vertices around; empty for vertices
  Eigen::ArrayXf pixel_m;  // width of a pixel there, across the view; empty for vertices

  int count() const { return static_cast<int>(index.size()); }
};

struct HairPoints {
  std::vector<int> index;  // fragment
  Eigen::MatrixX3f origin;
  Eigen::VectorXf near;  // rays start outside the hair's own thickness
  std::vector<Strand> strand;
  // Points of the same hair in the pixels around, itself included: those of p are near_point[first_near[p]] .. [first_near[p + 1] - 1].
  std::vector<int> first_near, near_point;
  // Those that rays are traced for: every second one, and those without any such beside them. The mean of a neighbourhood says as much.
  std::vector<std::uint8_t> traced;

  int count() const { return static_cast<int>(index.size()); }
};

SurfacePoints fragment_points(const Scene& scene, const SceneTransport& transport, const ViewTransport& view);
SurfacePoints vertex_points(const Scene& scene, const SceneTransport& transport);
HairPoints hair_points(const Scene& scene, const Fragments& fragments, const FragmentSurface& surface,
                       const Eigen::Vector3f& camera_position);

}  // namespace faceprobe::synth

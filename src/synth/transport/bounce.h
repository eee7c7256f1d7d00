#pragma once
// The second transport: light that reaches a vertex from other vertices.

#include "faceprobe/synth/scene.h"
#include "faceprobe/synth/transport.h"
#include "synth/transport/cell_set.h"

namespace faceprobe::synth {

// From the rows, normals and visibility of `transport`, whose bounce it returns. rays: at most, per row.
Eigen::SparseMatrix<float, Eigen::RowMajor> build_bounce(const Scene& scene, const SceneTransport& transport,
                                                         const std::vector<int>& vertices, const CellSet& cells,
                                                         int rays, int threads);

// Distance from the surface at which rays start, metres.
inline constexpr float kRayOffset = 1e-4F;
// The direction, or the nearest one that is just above the tangent plane.
Eigen::Vector3f above_surface(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal);

}  // namespace faceprobe::synth

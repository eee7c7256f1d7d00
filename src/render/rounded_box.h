#pragma once
// A box with round edges and corners.
//
//   const TriangleMesh brick = rounded_box({0.2F, 0.1F, 0.1F}, 0.02F);

#include "faceprobe/render/model.h"

#include <Eigen/Core>

namespace faceprobe::render {

// Centred on the origin. Throws std::invalid_argument unless 0 < radius < half of the shortest side.
TriangleMesh rounded_box(const Eigen::Vector3f& size, float radius);

}  // namespace faceprobe::render

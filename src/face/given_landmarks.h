#pragma once
// Five or 68 landmarks that a user knows: what they say about the mesh.

#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"

#include <Eigen/Core>

namespace faceprobe::face {

// Eye centres left to right in the image, nose tip, mouth corners left to right. Throws Error(kUsage) unless `given`
// holds 5 or 68 finite points.
Eigen::Matrix<float, 5, 2> five_points(const Eigen::MatrixX2f& given);

// Rigid fit of the canonical mesh to the given points: landmarks are its projected vertices.
Face rough_face(const Eigen::MatrixX2f& given, const CanonicalMesh& mesh, const Camera& camera);

// Mean distance between the five points of the mesh and the given ones, as a fraction of the face's size (the larger of
// the distance between the eyes and from the eyes to the mouth, so that it holds for profiles).
float disagreement(const Eigen::MatrixX3f& landmarks_px, const Eigen::MatrixX2f& given);

}  // namespace faceprobe::face

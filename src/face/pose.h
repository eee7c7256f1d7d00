#pragma once
// Where the head is: the rigid motion that takes the canonical face onto landmarks seen by a known camera, and the mesh
// in metres that follows from it.

#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace faceprobe::face {

// Least-squares pose of >= 4 face points (metres, canonical frame) seen at the given pixels. Throws Error(kNoFace) when
// the points fit no face in front of the camera.
Eigen::Isometry3d fit_pose(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                           const Camera& camera);

// Root mean square distance between the points and their projections, px.
double reprojection_rms_px(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                           const Camera& camera, const Eigen::Isometry3d& camera_from_face);

// Vertices that expressions move little: not the mouth, jaw, brows and eyelids.
std::vector<int> rigid_vertices(const CanonicalMesh& mesh);

// The face's pose from all its landmarks (only the rigid vertices are used).
Eigen::Isometry3d fit_pose(const Eigen::MatrixX3f& landmarks_px, const CanonicalMesh& mesh, const Camera& camera);

// 468 x 3, camera frame, metres: every vertex lies on the ray of its landmark, at the depth that the landmarks' own z
// gives it, scaled and placed by the pose.
Eigen::MatrixX3f posed_mesh(const Eigen::MatrixX3f& landmarks_px, const Eigen::Isometry3d& camera_from_face,
                            const CanonicalMesh& mesh, const Camera& camera);

}  // namespace faceprobe::face

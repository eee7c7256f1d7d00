#pragma once
// Poses that a fit from pixels may end at, each a least-squares minimum from another start; the best is for the caller to choose. By OpenCV
// where it is linked, else by the plain functions, which lack the closed form and start from more guesses.

#include "faceprobe/face/face.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace faceprobe::face {

// A head that looks into the camera, as large and as tilted in the picture as the points are; camera_from_face.
Eigen::Isometry3d frontal_guess(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                                const Camera& camera);

namespace plain {

// camera_from_face; may hold poses behind the camera or that are not finite.
std::vector<Eigen::Isometry3d> candidate_poses(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                                               const Camera& camera);

}  // namespace plain

#ifdef FACEPROBE_WITHOUT_OPENCV
using plain::candidate_poses;
#else
std::vector<Eigen::Isometry3d> candidate_poses(const Eigen::MatrixX3d& points_face_m, const Eigen::MatrixX2d& points_px,
                                               const Camera& camera);
#endif

}  // namespace faceprobe::face

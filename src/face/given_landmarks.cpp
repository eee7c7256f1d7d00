#include "face/given_landmarks.h"

#include "face/landmark_sets.h"
#include "face/pose.h"
#include "faceprobe/core/error.h"

#include <algorithm>

namespace faceprobe::face {
namespace {

// #5 x columns: the five points as means of mesh vertices.
Eigen::MatrixXf five_of_mesh(const Eigen::MatrixXf& vertices) {
  Eigen::MatrixXf points(5, vertices.cols());
  points.row(0) = 0.5F * (vertices.row(kRightEyeOuterCorner) + vertices.row(kRightEyeInnerCorner));
  points.row(1) = 0.5F * (vertices.row(kLeftEyeInnerCorner) + vertices.row(kLeftEyeOuterCorner));
  points.row(2) = vertices.row(kNoseTipVertex);
  points.row(3) = vertices.row(kRightMouthCorner);
  points.row(4) = vertices.row(kLeftMouthCorner);
  return points;
}

void check(const Eigen::MatrixX2f& given) {
  if (given.rows() != 5 && given.rows() != 68) {
    throw Error(ExitCode::kUsage, "Found " + std::to_string(given.rows()) +
                                      " landmarks; give 5 (eyes, nose tip, mouth corners) or 68 (iBUG order).");
  }
  if (!given.allFinite())
    throw Error(ExitCode::kUsage, "A given landmark is not a number; all must be pixels of the photo.");
}

}  // namespace

Eigen::Matrix<float, 5, 2> five_points(const Eigen::MatrixX2f& given) {
  check(given);
  if (given.rows() == 5) return given;
  Eigen::Matrix<float, 5, 2> points;
  points.row(0) = given.middleRows(36, 6).colwise().mean();
  points.row(1) = given.middleRows(42, 6).colwise().mean();
  points.row(2) = given.row(30);
  points.row(3) = given.row(48);
  points.row(4) = given.row(54);
  return points;
}

Face rough_face(const Eigen::MatrixX2f& given, const CanonicalMesh& mesh, const Camera& camera) {
  check(given);
  Eigen::MatrixX3d face;
  Eigen::MatrixX2d px;
  if (given.rows() == 5) {
    face = five_of_mesh(mesh.vertices_m).cast<double>();
    px = given.cast<double>();
  } else {
    face = mesh.vertices_m(kIbugVertices, Eigen::all).cast<double>();
    px = given.bottomRows(68 - kFirstFixedIbugPoint).cast<double>();
  }
  Face result;
  result.camera_from_face = fit_pose(face, px, camera);
  result.rough_landmarks = true;
  result.score = 1;
  result.vertices_cam_m.resize(kMeshVertices, 3);
  result.landmarks_px.resize(kMeshVertices, 3);
  const double px_per_m = camera.focal_px / result.position_m().norm();
  for (int i = 0; i < kMeshVertices; ++i) {
    const Eigen::Vector3d vertex = result.camera_from_face * mesh.vertices_m.row(i).transpose().cast<double>();
    result.vertices_cam_m.row(i) = vertex.cast<float>().transpose();
    result.landmarks_px.row(i).head<2>() = camera.project(vertex).cast<float>().transpose();
    result.landmarks_px(i, 2) = static_cast<float>(-vertex.z() * px_per_m);
  }
  result.landmarks_px.col(2).array() -= result.landmarks_px.col(2).mean();
  result.reprojection_rms_px = reprojection_rms_px(face, px, camera, result.camera_from_face);
  return result;
}

float disagreement(const Eigen::MatrixX3f& landmarks_px, const Eigen::MatrixX2f& given) {
  const Eigen::MatrixXf wanted = five_points(given);
  const Eigen::MatrixXf found = five_of_mesh(landmarks_px.leftCols<2>());
  const float across = (wanted.row(1) - wanted.row(0)).norm();
  const float down = 0.5F * (wanted.row(0) + wanted.row(1) - wanted.row(3) - wanted.row(4)).norm();
  return (wanted - found).rowwise().norm().mean() / std::max({across, down, 1e-3F});
}

}  // namespace faceprobe::face

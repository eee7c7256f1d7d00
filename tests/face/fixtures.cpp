#include "face/fixtures.h"

#include "face/landmark_sets.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/io/data_files.h"

#include <unistd.h>
#include <array>
#include <fstream>
#include <sstream>

namespace faceprobe::face {

const CanonicalMesh& canonical_mesh() {
  static const CanonicalMesh mesh = load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  return mesh;
}

Eigen::Isometry3d head_pose(double yaw_deg, double pitch_deg, double roll_deg, const Eigen::Vector3d& position_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(radians(-roll_deg), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(radians(yaw_deg), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(radians(-pitch_deg), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = position_m;
  return pose;
}

Eigen::MatrixX3f projected_landmarks(const Camera& camera, const Eigen::Isometry3d& camera_from_face) {
  const Eigen::Matrix3Xd points = camera_from_face * canonical_mesh().vertices_m.cast<double>().transpose();
  const Eigen::Vector3d centre = points.rowwise().mean();
  const double px_per_m = camera.focal_px / -centre.z();
  Eigen::MatrixX3f landmarks(points.cols(), 3);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    landmarks.row(i).head<2>() = camera.project(points.col(i)).cast<float>().transpose();
    landmarks(i, 2) = static_cast<float>((points.col(i) - centre).dot(centre.normalized()) * px_per_m);
  }
  return landmarks;
}

Eigen::MatrixX2f projected_five(const Camera& camera, const Eigen::Isometry3d& camera_from_face) {
  // Means are taken on the face: the mean of two projections is not the projection of the mean.
  const Eigen::MatrixX3f& v = canonical_mesh().vertices_m;
  Eigen::MatrixX3f five(5, 3);
  five << (v.row(33) + v.row(133)) / 2, (v.row(362) + v.row(263)) / 2, v.row(4), v.row(61), v.row(291);
  Eigen::MatrixX2f px(5, 2);
  for (int i = 0; i < 5; ++i) {
    px.row(i) = camera.project(camera_from_face * five.row(i).transpose().cast<double>()).cast<float>().transpose();
  }
  return px;
}

Eigen::MatrixX2f projected_sixty_eight(const Camera& camera, const Eigen::Isometry3d& camera_from_face) {
  constexpr std::array<int, 17> kJaw = {127, 234, 93,  58,  172, 136, 149, 148, 152,
                                        377, 378, 365, 397, 288, 323, 454, 356};
  const Eigen::MatrixX3f all = projected_landmarks(camera, camera_from_face);
  Eigen::MatrixX2f px(68, 2);
  for (int i = 0; i < 68; ++i) {
    const int vertex = i < 17 ? kJaw[static_cast<std::size_t>(i)] : kIbugVertices[static_cast<std::size_t>(i - 17)];
    px.row(i) = all.row(vertex).head<2>();
  }
  return px;
}

double angle_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return degrees(Eigen::AngleAxisd(a.rotation().transpose() * b.rotation()).angle());
}

TemporaryFile::TemporaryFile(const std::string& content) { std::ofstream(path(), std::ios::binary) << content; }

std::string file_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace faceprobe::face

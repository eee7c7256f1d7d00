#pragma once

#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"
#include "support/temp_folder.h"

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

namespace faceprobe::face {

const CanonicalMesh& canonical_mesh();

// A head turned by the angles (degrees; yaw to the photo's right, pitch up, roll clockwise in the photo).
Eigen::Isometry3d head_pose(double yaw_deg, double pitch_deg, double roll_deg, const Eigen::Vector3d& position_m);

// Landmarks of the rigid canonical face: projected x and y, and the z a weak-perspective network would give.
Eigen::MatrixX3f projected_landmarks(const Camera& camera, const Eigen::Isometry3d& camera_from_face);

// The five and the 68 iBUG points of the same; jaw points on the outline of the mesh.
Eigen::MatrixX2f projected_five(const Camera& camera, const Eigen::Isometry3d& camera_from_face);
Eigen::MatrixX2f projected_sixty_eight(const Camera& camera, const Eigen::Isometry3d& camera_from_face);

double angle_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

// A file in a folder of its own, removed with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content);
  std::filesystem::path path() const { return folder_ / "file"; }

 private:
  testing::TempFolder folder_;
};

std::string file_text(const std::filesystem::path& path);

}  // namespace faceprobe::face

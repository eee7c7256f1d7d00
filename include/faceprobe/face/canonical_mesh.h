#pragma once
// The mean face that all landmarks refer to: MediaPipe's canonical mesh, 468 vertices and 898 triangles, eyes and mouth
// closed over, in metres (the file is in centimetres). Axes: +x the subject's left (right in a frontal photo), +y up,
// +z out of the face.
//
//   const CanonicalMesh mesh = load_canonical_mesh(io::data_file("canonical-face-model.obj"));

#include <Eigen/Core>
#include <filesystem>

namespace faceprobe::face {

struct CanonicalMesh {
  Eigen::MatrixX3f vertices_m;  // 468 x 3
  Eigen::MatrixX2f uv;          // 468 x 2, in [0, 1], v up
  Eigen::MatrixX3i triangles;   // 898 x 3, counter-clockwise seen from outside
};

// Throws Error(kModel) unless the file is an OBJ with 468 vertices and valid triangles.
CanonicalMesh load_canonical_mesh(const std::filesystem::path& obj);

}  // namespace faceprobe::face

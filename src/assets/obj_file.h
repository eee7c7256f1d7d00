#pragma once
// A Wavefront OBJ as arrays, checked: tinyobjloader takes what it cannot read for zero, and lets indices out of range pass.

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace faceprobe::assets {

struct ObjFile {
  Eigen::MatrixX3f vertices;
  Eigen::MatrixX2f uv;             // may be empty
  Eigen::MatrixX3i triangles;      // polygons cut into fans
  Eigen::MatrixX3i triangle_uv;    // empty unless every corner has a texture point
  std::vector<int> triangle_face;  // number of the polygon in the file, from 0
  std::filesystem::path texture;   // map_Kd of the first material that names one; may be empty
};

// Throws Error(kInput): unreadable, a number that is none, not finite, an index out of range, no faces (unless vertices_only).
ObjFile read_obj(const std::filesystem::path& path, bool vertices_only = false);

}  // namespace faceprobe::assets

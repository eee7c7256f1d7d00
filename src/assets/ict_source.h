#pragma once
// What an ICT-FaceKit folder holds, in its own units and numbering, whether as arrays or as OBJ files.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::assets {

inline constexpr int kIctVertices = 26719;
inline constexpr int kIctHeadVertices = 11248;  // skin of face, head and neck

struct IctSource {
  Eigen::MatrixX3f neutral;  // kIctVertices, centimetres
  Eigen::MatrixX2f uv;
  Eigen::MatrixX3i triangles, triangle_uv;
  std::vector<int> triangle_region;        // 0 .. 16
  std::vector<Eigen::MatrixX3f> identity;  // offsets of the first vertices: all, or kIctHeadVertices
  std::vector<Eigen::MatrixX3f> expression;
  std::vector<std::string> expression_names;
};

bool has_ict_arrays(const std::filesystem::path& folder);
bool has_ict_objs(const std::filesystem::path& folder);
IctSource read_ict_arrays(const std::filesystem::path& folder);
IctSource read_ict_objs(const std::filesystem::path& folder);

}  // namespace faceprobe::assets

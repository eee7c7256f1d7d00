#include "assets/ict_source.h"

#include "assets/array.h"
#include "assets/obj_file.h"

#include <algorithm>
#include <array>
#include <utility>

namespace faceprobe::assets {
namespace {

constexpr const char* kNeutralFile = "generic_neutral_mesh.obj";
constexpr int kFaces = 26384;
// Last face of each region, in the order of the file (README of ICT-FaceKit, "Geometry Table").
constexpr std::array<int, 17> kLastFace = {9229,  11143, 13225, 13629, 14033, 17005, 21495, 23093, 24691,
                                           24854, 25017, 25032, 25047, 25175, 25303, 25843, 26383};

Eigen::MatrixX3f read_offsets(const std::filesystem::path& path, const Eigen::MatrixX3f& neutral) {
  const ObjFile obj = read_obj(path, true);
  if (obj.vertices.rows() != neutral.rows()) {
    refuse_input(quoted(path) + " has " + std::to_string(obj.vertices.rows()) + " vertices, and the neutral mesh has " +
                 std::to_string(neutral.rows()) + ".");
  }
  return obj.vertices - neutral;
}

}  // namespace

bool has_ict_objs(const std::filesystem::path& folder) { return std::filesystem::exists(folder / kNeutralFile); }

IctSource read_ict_objs(const std::filesystem::path& folder) {
  const std::filesystem::path neutral_path = folder / kNeutralFile;
  ObjFile neutral = read_obj(neutral_path);
  if (neutral.vertices.rows() != kIctVertices || neutral.triangle_face.back() != kFaces - 1 ||
      neutral.triangle_uv.rows() == 0) {
    refuse_input(quoted(neutral_path) + " has " + std::to_string(neutral.vertices.rows()) + " vertices and " +
                 std::to_string(neutral.triangle_face.back() + 1) + " faces" +
                 (neutral.triangle_uv.rows() == 0 ? " without texture" : "") + "; ICT-FaceKit's mesh has " +
                 std::to_string(kIctVertices) + ", " + std::to_string(kFaces) + " and texture points.");
  }
  IctSource ict;
  ict.neutral = std::move(neutral.vertices);
  ict.uv = std::move(neutral.uv);
  ict.triangles = std::move(neutral.triangles);
  ict.triangle_uv = std::move(neutral.triangle_uv);
  for (const int face : neutral.triangle_face) {
    ict.triangle_region.push_back(static_cast<int>(std::ranges::lower_bound(kLastFace, face) - kLastFace.begin()));
  }

  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".obj" && entry.path().filename() != kNeutralFile) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    if (name.starts_with("identity")) {
      ict.identity.push_back(read_offsets(file, ict.neutral));
    } else {
      ict.expression.push_back(read_offsets(file, ict.neutral));
      ict.expression_names.push_back(name);
    }
  }
  return ict;
}

}  // namespace faceprobe::assets

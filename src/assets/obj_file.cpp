#include "assets/obj_file.h"

#include "assets/array.h"
#include "faceprobe/io/data_files.h"

#include <tiny_obj_loader.h>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace faceprobe::assets {
namespace {

constexpr std::int64_t kMaxObjBytes = 256LL << 20;
constexpr double kMaxCoordinate = 1e6;

std::string_view next_word(std::string_view& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  const std::size_t last = std::min(line.find_first_of(" \t\r", first), line.size());
  const std::string_view word = line.substr(first, last - first);
  line.remove_prefix(last);
  return word;
}

double parse_coordinate(std::string_view word, const std::string& name, int line_number) {
  double value = 0;
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [next, fault] = std::from_chars(first, end, value);
  if (word.empty() || fault != std::errc() || next != end || !(std::abs(value) <= kMaxCoordinate)) {
    refuse_input(name + " has '" + std::string(word) + "' in line " + std::to_string(line_number) +
                 " where a finite number is needed.");
  }
  return value;
}

// The vertices, read here so that "nan" and text are found out, and the texture points' numbers checked.
Eigen::MatrixX3f scan_vertices(std::string_view text, const std::string& name) {
  std::vector<float> values;
  int line_number = 0;
  while (!text.empty()) {
    ++line_number;
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::string_view keyword = next_word(line);
    if (keyword == "v") {
      for (int axis = 0; axis < 3; ++axis) {
        values.push_back(static_cast<float>(parse_coordinate(next_word(line), name, line_number)));
      }
    } else if (keyword == "vt") {
      for (int axis = 0; axis < 2; ++axis) parse_coordinate(next_word(line), name, line_number);
    }
  }
  if (values.empty()) refuse_input(name + " holds no vertices; a Wavefront OBJ mesh is needed.");
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3);
}

struct Corners {
  std::vector<std::array<int, 3>> triangles, triangle_uv;
  std::vector<int> triangle_face;
  bool has_uv = true;
};

void add_polygon(const tinyobj::index_t* corner, int sides, int face, Corners& out) {
  for (int k = 2; k < sides; ++k) {
    const std::array<int, 3> fan = {0, k - 1, k};
    std::array<int, 3> vertex{}, texture{};
    for (std::size_t i = 0; i < 3; ++i) {
      vertex[i] = corner[fan[i]].vertex_index;
      texture[i] = corner[fan[i]].texcoord_index;
      if (texture[i] < 0) out.has_uv = false;
    }
    out.triangles.push_back(vertex);
    out.triangle_uv.push_back(texture);
    out.triangle_face.push_back(face);
  }
}

Corners collect_triangles(const std::vector<tinyobj::shape_t>& shapes) {
  Corners corners;
  int face = 0;
  for (const tinyobj::shape_t& shape : shapes) {
    std::size_t at = 0;
    for (const auto sides : shape.mesh.num_face_vertices) {
      add_polygon(shape.mesh.indices.data() + at, static_cast<int>(sides), face++, corners);
      at += static_cast<std::size_t>(sides);
    }
  }
  return corners;
}

Eigen::MatrixX3i as_matrix(const std::vector<std::array<int, 3>>& rows, Eigen::Index limit, const std::string& what) {
  Eigen::MatrixX3i matrix(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (rows[i][k] < 0 || rows[i][k] >= limit) {
        refuse_input(what + " " + std::to_string(rows[i][k] + 1) + " in a face, and there are " +
                     std::to_string(limit) + ".");
      }
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = rows[i][k];
    }
  }
  return matrix;
}

std::filesystem::path first_texture(const std::vector<tinyobj::material_t>& materials) {
  for (const tinyobj::material_t& material : materials) {
    if (!material.diffuse_texname.empty()) return material.diffuse_texname;
  }
  return {};
}

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, bool vertices_only) {
  const std::string name = quoted(path);
  const std::vector<std::byte> bytes = io::read_file(path, kMaxObjBytes);
  ObjFile obj;
  obj.vertices = scan_vertices({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  if (vertices_only) return obj;

  tinyobj::ObjReaderConfig config;
  config.triangulate = false;  // so that polygons keep their numbers
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromFile(path.string(), config)) refuse_input(name + " is not a Wavefront OBJ: " + reader.Error());
  const Corners corners = collect_triangles(reader.GetShapes());
  if (corners.triangles.empty())
    refuse_input(name + " holds no faces, only " + std::to_string(obj.vertices.rows()) + " vertices.");
  obj.triangles = as_matrix(corners.triangles, obj.vertices.rows(), name + " names vertex");
  obj.triangle_face = corners.triangle_face;
  const std::vector<float>& uv = reader.GetAttrib().texcoords;
  if (corners.has_uv && !uv.empty()) {
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
    obj.uv = Eigen::Map<const Rows>(uv.data(), static_cast<Eigen::Index>(uv.size() / 2), 2);
    obj.triangle_uv = as_matrix(corners.triangle_uv, obj.uv.rows(), name + " names texture point");
  }
  obj.texture = first_texture(reader.GetMaterials());
  return obj;
}

}  // namespace faceprobe::assets

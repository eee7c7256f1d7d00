#include "pipeline/face_meshes.h"

#include "faceprobe/core/vertex_normals.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/io/data_files.h"

#include <OpenImageIO/strutil.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::pipeline {
namespace {

using Gltf = nlohmann::ordered_json;

// Numbers of glTF 2.0, section 3.6.
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kVertexData = 34962;
constexpr int kIndexData = 34963;

Gltf corner_of(const Eigen::RowVector3f& v) { return std::array<float, 3>{v.x(), v.y(), v.z()}; }

// Lists of numbers, one after another in one buffer. Each has a number of bytes that four divide.
class Numbers {
 public:
  explicit Numbers(Gltf& gltf) : gltf_(gltf) {}

  // The accessor's number.
  std::size_t add(const Eigen::MatrixX3f& rows, bool with_bounds) {
    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> in_order = rows;
    Gltf accessor = append(in_order.data(), static_cast<std::size_t>(in_order.size()), kVertexData);
    accessor["componentType"] = kFloat;
    accessor["count"] = rows.rows();
    accessor["type"] = "VEC3";
    if (with_bounds) {
      accessor["min"] = corner_of(rows.colwise().minCoeff());
      accessor["max"] = corner_of(rows.colwise().maxCoeff());
    }
    gltf_["accessors"].push_back(std::move(accessor));
    return gltf_["accessors"].size() - 1;
  }

  std::size_t add(const Eigen::MatrixX3i& triangles) {
    std::vector<std::uint16_t> corners;
    for (const auto& row : triangles.rowwise()) {
      for (const int corner : row) corners.push_back(static_cast<std::uint16_t>(corner));
    }
    Gltf accessor = append(corners.data(), corners.size(), kIndexData);
    accessor["componentType"] = kUnsignedShort;
    accessor["count"] = corners.size();
    accessor["type"] = "SCALAR";
    gltf_["accessors"].push_back(std::move(accessor));
    return gltf_["accessors"].size() - 1;
  }

  // The buffer itself, after all lists.
  void finish() {
    Gltf buffer;
    buffer["byteLength"] = bytes_.size();
    buffer["uri"] =
        "data:application/octet-stream;base64," + OIIO::Strutil::base64_encode({bytes_.data(), bytes_.size()});
    gltf_["buffers"].push_back(std::move(buffer));
  }

 private:
  template <class Number>
  Gltf append(const Number* numbers, std::size_t count, int target) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + count * sizeof(Number));
    std::memcpy(bytes_.data() + begin, numbers, count * sizeof(Number));  // glTF is little-endian, as what we run on
    gltf_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}, {"target", target}});
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    Gltf accessor;
    accessor["bufferView"] = gltf_["bufferViews"].size() - 1;
    return accessor;
  }

  Gltf& gltf_;
  std::string bytes_;
};

// A number and no pointer: a new member of an ordered object moves all that it holds.
std::optional<std::size_t> node_of(const Gltf& gltf, const std::string& name) {
  const Gltf& nodes = gltf.at("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].value("name", "") == name) return i;
  }
  return std::nullopt;
}

Gltf grey() {
  Gltf material;
  material["name"] = "Face";
  // A metal, which is what glTF takes without words, would be black under lamps alone.
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", {0.6, 0.6, 0.6, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
  material["doubleSided"] = true;  // a mask: there is no back of the head
  return material;
}

}  // namespace

void add_face_meshes(Gltf& gltf, const Estimate& estimate) {
  const Eigen::MatrixX3i triangles = face::load_canonical_mesh(io::data_file("canonical-face-model.obj")).triangles;
  Numbers numbers(gltf);
  std::size_t corners = 0;
  for (std::size_t i = 0; i < estimate.faces.size(); ++i) {
    const Eigen::MatrixX3f& vertices = estimate.faces[i].face.vertices_cam_m;
    const std::string name = "Face " + std::to_string(i + 1);
    const std::optional<std::size_t> node = node_of(gltf, name);
    if (!node || vertices.rows() != face::kMeshVertices) continue;
    if (!gltf.contains("meshes")) {
      corners = numbers.add(triangles);  // the same for all
      gltf["materials"].push_back(grey());
    }
    const auto place = gltf["nodes"][*node].at("translation").get<std::array<double, 3>>();
    const Eigen::RowVector3f from = Eigen::RowVector3d(place[0], place[1], place[2]).cast<float>();
    Gltf primitive;
    primitive["attributes"]["POSITION"] = numbers.add(vertices.rowwise() - from, true);
    primitive["attributes"]["NORMAL"] = numbers.add(vertex_normals(vertices, triangles), false);
    primitive["indices"] = corners;
    primitive["material"] = 0;
    gltf["nodes"][*node]["mesh"] = gltf.contains("meshes") ? gltf["meshes"].size() : 0;
    Gltf mesh;
    mesh["name"] = name;
    mesh["primitives"].push_back(std::move(primitive));
    gltf["meshes"].push_back(std::move(mesh));
  }
  if (gltf.contains("meshes")) numbers.finish();
}

}  // namespace faceprobe::pipeline

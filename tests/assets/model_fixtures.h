#pragma once
// Small models, written as text.

#include "file_fixtures.h"

#include <cstring>
#include <nlohmann/json.hpp>

namespace faceprobe::assets::testing {

// A quad with texture points, facing +z.
inline constexpr char kQuad[] =
    "v -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "usemtl paint\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";

// A cube of side 2 around the origin, six quads.
inline std::string cube_ply(const std::string& faces = "6", bool coloured = false) {
  std::string text =
      "ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
  if (coloured) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face " + faces + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) text += (i >> axis) % 2 == 1 ? "1 " : "-1 ";
    text += coloured ? "255 188 0\n" : "\n";
  }
  return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

inline std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

// The corners (0,0,0), (1,0,0), (0,1,0), their texture points (0,1), (1,1), (0,0) in glTF's way, and indices of 16 bits: 66 bytes.
inline std::string triangle_bytes() {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 0};
  const std::uint16_t indices[] = {0, 1, 2};
  std::string bytes(sizeof numbers + sizeof indices, '\0');
  std::memcpy(bytes.data(), numbers, sizeof numbers);
  std::memcpy(bytes.data() + sizeof numbers, indices, sizeof indices);
  return bytes;
}

// One triangle, one node, a metal; to be changed by the test.
inline nlohmann::json triangle_gltf() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"name": "gold", "pbrMetallicRoughness":
      {"baseColorFactor": [1, 0.75, 0.25, 1], "metallicFactor": 1, "roughnessFactor": 0.25}}],
    "buffers": [{"byteLength": 66}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                    {"buffer": 0, "byteOffset": 60, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
                  {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}]})");
}

// The document with the triangle's bytes in it.
inline std::string gltf_text(nlohmann::json document) {
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(triangle_bytes());
  return document.dump();
}

// As one binary file.
inline std::string glb_text(const nlohmann::json& document, std::string binary = triangle_bytes()) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFFU);
    return bytes;
  };
  return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace faceprobe::assets::testing

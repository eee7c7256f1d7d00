#include "faceprobe/face/canonical_mesh.h"

#include "faceprobe/core/error.h"
#include "faceprobe/face/face.h"

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace faceprobe::face {
namespace {

constexpr int kTriangles = 898;
constexpr float kMetresPerUnit = 0.01F;  // the file is in centimetres
constexpr double kMaxCoordinate = 1000;

struct Reader {
  const std::filesystem::path& path;
  int line_number = 0;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::kModel,
                "The face mesh '" + path.string() + "' " + what + "; run scripts/setup.sh to fetch it again.");
  }

  template <std::size_t N>
  std::array<float, N> numbers(std::istringstream& line) const {
    std::array<float, N> values{};
    for (float& value : values) {
      std::string text;
      line >> text;
      std::size_t used = 0;
      double parsed = 0;
      try {
        parsed = std::stod(text, &used);
      } catch (const std::exception&) {
        used = 0;
      }
      if (used == 0 || used != text.size() || !std::isfinite(parsed) || std::abs(parsed) > kMaxCoordinate) {
        fail("has '" + text + "' where line " + std::to_string(line_number) + " needs a number");
      }
      value = static_cast<float>(parsed);
    }
    return values;
  }

  // "12/34" or "12/34/56": vertex and texture vertex, counted from 1; an index here is counted from 0.
  std::array<int, 2> corner(std::istringstream& line) const {
    std::string text;
    line >> text;
    std::istringstream parts(text);
    std::array<int, 2> index{};
    char slash = 0;
    parts >> index[0] >> slash >> index[1];
    if (!parts || slash != '/' || index[0] < 1 || index[0] > kMeshVertices || index[1] < 1 || index[1] > kMeshVertices) {
      fail("has no valid corner 'vertex/texture' in line " + std::to_string(line_number));
    }
    return {index[0] - 1, index[1] - 1};
  }
};

}  // namespace

CanonicalMesh load_canonical_mesh(const std::filesystem::path& obj) {
  Reader reader{obj};
  std::ifstream file(obj);
  if (!file) reader.fail("cannot be read");

  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<float, 2>> texture;
  std::vector<std::array<std::array<int, 2>, 3>> triangles;
  for (std::string text; std::getline(file, text);) {
    ++reader.line_number;
    std::istringstream line(text);
    std::string keyword;
    line >> keyword;
    if (keyword == "v") {
      vertices.push_back(reader.numbers<3>(line));
    } else if (keyword == "vt") {
      texture.push_back(reader.numbers<2>(line));
    } else if (keyword == "f") {
      triangles.push_back({reader.corner(line), reader.corner(line), reader.corner(line)});
      if (std::string rest; line >> rest)
        reader.fail("has a face that is no triangle in line " + std::to_string(reader.line_number));
    }
    if (vertices.size() > kMeshVertices || texture.size() > kMeshVertices || triangles.size() > kTriangles) break;
  }
  if (vertices.size() != kMeshVertices || texture.size() != kMeshVertices || triangles.size() != kTriangles) {
    reader.fail("has " + std::to_string(vertices.size()) + " vertices, " + std::to_string(texture.size()) +
                " texture vertices and " + std::to_string(triangles.size()) + " triangles instead of 468, 468 and 898");
  }

  CanonicalMesh mesh;
  mesh.vertices_m.resize(kMeshVertices, 3);
  mesh.uv.setZero(kMeshVertices, 2);
  mesh.triangles.resize(kTriangles, 3);
  for (int i = 0; i < kMeshVertices; ++i) {
    const auto& vertex = vertices[static_cast<std::size_t>(i)];
    mesh.vertices_m.row(i) = kMetresPerUnit * Eigen::RowVector3f(vertex[0], vertex[1], vertex[2]);
  }
  for (int i = 0; i < kTriangles; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto [vertex, at] = triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      mesh.triangles(i, k) = vertex;
      // The file numbers texture vertices on their own; each vertex has exactly one.
      mesh.uv.row(vertex) =
          Eigen::RowVector2f(texture[static_cast<std::size_t>(at)][0], texture[static_cast<std::size_t>(at)][1]);
    }
    const auto triangle = mesh.triangles.row(i);
    if (triangle(0) == triangle(1) || triangle(1) == triangle(2) || triangle(2) == triangle(0)) {
      reader.fail("has a triangle that uses a vertex twice");
    }
  }
  return mesh;
}

}  // namespace faceprobe::face

#include "assets/ict_source.h"

#include "assets/npy.h"
#include "faceprobe/io/data_files.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

namespace faceprobe::assets {
namespace {

constexpr std::int64_t kMaxMetaBytes = 16LL << 20;

const Array& require(const Arrays& arrays, const std::string& name, const std::filesystem::path& file) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) refuse_input(quoted(file) + " holds no array '" + name + "'.");
  return found->second;
}

std::vector<Eigen::MatrixX3f> split_modes(const Array& array, Eigen::Index vertices, const std::string& what) {
  if (array.shape.size() != 3 || array.shape[1] != static_cast<std::size_t>(vertices) || array.shape[2] != 3) {
    refuse_input(what + " is " + shape_text(array.shape) + "; modes x " + std::to_string(vertices) + " x 3 is needed.");
  }
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  std::vector<Eigen::MatrixX3f> modes;
  for (std::size_t i = 0; i < array.shape[0]; ++i) {
    modes.emplace_back(
        Eigen::Map<const Rows>(array.values.data() + i * static_cast<std::size_t>(vertices) * 3, vertices, 3));
  }
  return modes;
}

// Quads with -1 in the fourth place of triangles, in vertices and texture points alike, cut along the diagonal 0-2.
void cut_quads(const Eigen::MatrixXi& faces, const Eigen::MatrixXi& faces_uv, const Eigen::MatrixXi& face_region,
               const std::string& file, IctSource& ict) {
  if (faces_uv.rows() != faces.rows() || face_region.rows() != faces.rows()) {
    refuse_input(file + " has " + std::to_string(faces.rows()) + " faces, texture points for " +
                 std::to_string(faces_uv.rows()) + " and regions for " + std::to_string(face_region.rows()) + ".");
  }
  ict.triangles.resize(2 * faces.rows(), 3);
  ict.triangle_uv.resize(2 * faces.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (const auto& [b, c] : {std::pair(1, 2), std::pair(2, 3)}) {
      if (faces(f, c) < 0) continue;
      ict.triangles.row(count) << faces(f, 0), faces(f, b), faces(f, c);
      ict.triangle_uv.row(count++) << faces_uv(f, 0), faces_uv(f, b), faces_uv(f, c);
      ict.triangle_region.push_back(face_region(f, 0));
    }
  }
  ict.triangles.conservativeResize(count, 3);
  ict.triangle_uv.conservativeResize(count, 3);
}

void read_modes(const std::filesystem::path& folder, IctSource& ict) {
  const std::filesystem::path full = folder / "morphs_full_f16.npz";
  if (std::filesystem::exists(full)) {
    const Arrays morphs = read_npz(full);
    ict.identity = split_modes(require(morphs, "identity", full), kIctVertices, quoted(full) + ": 'identity'");
    ict.expression = split_modes(require(morphs, "expression", full), kIctVertices, quoted(full) + ": 'expression'");
    return;
  }
  const std::filesystem::path identity = folder / "identity_head_f16.npy";
  const std::filesystem::path expression = folder / "expression_head_f16.npy";
  ict.identity = split_modes(read_npy(identity), kIctHeadVertices, quoted(identity));
  ict.expression = split_modes(read_npy(expression), kIctHeadVertices, quoted(expression));
}

std::vector<std::string> read_names(const std::filesystem::path& path, std::size_t expressions) {
  const std::vector<std::byte> bytes = io::read_file(path, kMaxMetaBytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  try {
    auto names = nlohmann::json::parse(text, text + bytes.size()).at("expression_names").get<std::vector<std::string>>();
    if (names.size() == expressions) return names;
    refuse_input(quoted(path) + " names " + std::to_string(names.size()) + " expressions, and the arrays hold " +
                 std::to_string(expressions) + ".");
  } catch (const nlohmann::json::exception& fault) {
    refuse_input(quoted(path) + " does not list the names of the expressions: " + fault.what() + ".");
  }
}

}  // namespace

bool has_ict_arrays(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "ict_topology.npz");
}

IctSource read_ict_arrays(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "ict_topology.npz";
  const std::string file = quoted(path);
  const Arrays arrays = read_npz(path);
  IctSource ict;
  ict.neutral = rows_of_3(require(arrays, "neutral", path), "'neutral' of " + file);
  if (ict.neutral.rows() != kIctVertices) {
    refuse_input(file + " has " + std::to_string(ict.neutral.rows()) + " vertices; ICT-FaceKit's mesh has " +
                 std::to_string(kIctVertices) + ".");
  }
  const Array& uv = require(arrays, "uv", path);
  if (uv.shape.size() != 2 || uv.shape[1] != 2)
    refuse_input(file + ": 'uv' is " + shape_text(uv.shape) + "; N x 2 is needed.");
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
  ict.uv = Eigen::Map<const Rows>(uv.values.data(), static_cast<Eigen::Index>(uv.shape[0]), 2);
  cut_quads(integer_rows(require(arrays, "faces", path), 4, "'faces' of " + file),
            integer_rows(require(arrays, "faces_uv", path), 4, "'faces_uv' of " + file),
            integer_rows(require(arrays, "face_region", path), 1, "'face_region' of " + file), file, ict);
  read_modes(folder, ict);
  ict.expression_names = read_names(folder / "ict_meta.json", ict.expression.size());
  return ict;
}

}  // namespace faceprobe::assets

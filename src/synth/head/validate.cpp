#include "faceprobe/synth/head_model.h"

#include <cstddef>

namespace faceprobe::synth {
namespace {

std::string number(Eigen::Index value) { return std::to_string(value); }
Eigen::Index count(const auto& values) { return static_cast<Eigen::Index>(values.size()); }

bool all_in_range(const Eigen::MatrixX3i& indices, Eigen::Index limit) {
  return indices.size() == 0 || (indices.minCoeff() >= 0 && indices.maxCoeff() < limit);
}

std::string check_surface(const HeadModel& m) {
  if (m.neutral.rows() < 3 || m.triangles.rows() < 1) {
    return "it has " + number(m.neutral.rows()) + " vertices and " + number(m.triangles.rows()) +
           " triangles, a surface needs more";
  }
  if (!m.neutral.allFinite()) return "a vertex is not finite";
  if (!all_in_range(m.triangles, m.neutral.rows())) {
    return "a triangle names a vertex outside 0 .. " + number(m.neutral.rows() - 1);
  }
  if (count(m.triangle_material) != m.triangles.rows()) {
    return "it has " + number(m.triangles.rows()) + " triangles and materials for " + number(count(m.triangle_material));
  }
  for (const Material material : m.triangle_material) {
    if (material > Material::kTeeth) return "a triangle is of a material other than skin, eye, mouth and teeth";
  }
  if (count(m.vertex_region) != m.neutral.rows()) {
    return "it has " + number(m.neutral.rows()) + " vertices and regions for " + number(count(m.vertex_region));
  }
  return {};
}

std::string check_uv(const HeadModel& m) {
  if (m.uv.rows() == 0) return m.triangle_uv.rows() == 0 ? "" : "its triangles name texture points and it has none";
  if (!m.uv.allFinite()) return "a texture point is not finite";
  if (m.triangle_uv.rows() != m.triangles.rows()) {
    return "it has " + number(m.triangles.rows()) + " triangles and texture points for " + number(m.triangle_uv.rows());
  }
  if (!all_in_range(m.triangle_uv, m.uv.rows())) {
    return "a triangle names a texture point outside 0 .. " + number(m.uv.rows() - 1);
  }
  if (m.texture.empty() || m.texture.channels() == 3) return {};
  return "its texture has " + std::to_string(m.texture.channels()) + " channels instead of 3";
}

std::string check_modes(const std::vector<Eigen::MatrixX3f>& modes, const char* kind, Eigen::Index vertices, bool all) {
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const std::string name = std::string(kind) + " mode " + std::to_string(i);
    const Eigen::Index rows = modes[i].rows();
    if (all ? rows != vertices : rows > vertices)
      return name + " moves " + number(rows) + " of " + number(vertices) + " vertices";
    if (!modes[i].allFinite()) return name + " is not finite";
  }
  return {};
}

std::string check_landmarks(const HeadModel& m) {
  if (!m.landmarks.empty() && m.landmarks.size() != 68) {
    return "it has " + number(count(m.landmarks)) + " landmarks instead of 68 or none";
  }
  for (const int vertex : m.landmarks) {
    if (vertex < 0 || vertex >= m.neutral.rows()) {
      return "a landmark is vertex " + std::to_string(vertex) + " of " + number(m.neutral.rows());
    }
  }
  if (!m.dense_landmarks.empty() && m.dense_landmarks.size() != 468) {
    return "it has " + number(count(m.dense_landmarks)) + " dense landmarks instead of 468 or none";
  }
  for (const SurfacePoint& point : m.dense_landmarks) {
    if (point.triangle < 0 || point.triangle >= m.triangles.rows()) {
      return "a dense landmark lies on triangle " + std::to_string(point.triangle) + " of " + number(m.triangles.rows());
    }
    // A point that leaves its triangle by a thousandth is rounding, more is another point.
    if (!point.weights.allFinite() || std::abs(point.weights.sum() - 1.0F) > 1e-3F) {
      return "a dense landmark's weights do not sum to 1";
    }
  }
  return {};
}

std::string check_albedo(const HeadModel& m) {
  if (m.vertex_albedo.rows() != 0 && m.vertex_albedo.rows() != m.neutral.rows()) {
    return "it has " + number(m.neutral.rows()) + " vertices and albedo for " + number(m.vertex_albedo.rows());
  }
  if (!m.vertex_albedo.allFinite()) return "an albedo is not finite";
  if (m.vertex_albedo.rows() == 0 && !m.albedo_modes.empty()) return "it has albedo modes without a mean albedo";
  return check_modes(m.albedo_modes, "albedo", m.neutral.rows(), true);
}

}  // namespace

std::string HeadModel::validate() const {
  std::string fault = check_surface(*this);
  if (fault.empty()) fault = check_uv(*this);
  if (fault.empty()) fault = check_modes(identity, "identity", neutral.rows(), false);
  if (fault.empty()) fault = check_modes(expression, "expression", neutral.rows(), false);
  if (fault.empty() && !expression_names.empty() && expression_names.size() != expression.size()) {
    fault = "it has " + number(count(expression)) + " expressions and " + number(count(expression_names)) +
            " names for them";
  }
  if (fault.empty()) fault = check_landmarks(*this);
  if (fault.empty()) fault = check_albedo(*this);
  return fault.empty() ? "" : "The head model '" + name + "' does not fit together: " + fault + ".";
}

}  // namespace faceprobe::synth

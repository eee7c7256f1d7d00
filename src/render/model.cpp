#include "faceprobe/render/model.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace faceprobe::render {
namespace {

// How far a normal's squared length may be from 1: what readers of packed or rounded normals leave, not what a forgotten scale does.
constexpr float kUnitTolerance = 0.02F;

std::string wrong_rows(const char* what, Eigen::Index found, Eigen::Index vertices) {
  return std::string("needs one ") + what + " per vertex, found " + std::to_string(found) + " for " +
         std::to_string(vertices) + " vertices.";
}

// The end of a sentence that begins with the mesh's name; empty when all is well.
std::string mesh_fault(const TriangleMesh& mesh) {
  const Eigen::Index count = mesh.vertices.rows();
  if (mesh.normals.rows() != count) return wrong_rows("normal", mesh.normals.rows(), count);
  if (mesh.uv.rows() != 0 && mesh.uv.rows() != count) return wrong_rows("texture point", mesh.uv.rows(), count);
  if (!mesh.vertices.allFinite()) return "has vertices that are not finite; each coordinate must be a number.";
  if (!mesh.uv.allFinite()) return "has texture points that are not finite; each coordinate must be a number.";
  // Written so that NaN fails.
  if (!((mesh.normals.rowwise().squaredNorm().array() - 1).abs() <= kUnitTolerance).all()) {
    return "has normals that are not of unit length.";
  }
  if (mesh.triangles.rows() == 0) return {};
  const int least = mesh.triangles.minCoeff();
  const int most = mesh.triangles.maxCoeff();
  if (least < 0 || most >= count) {
    return "has " + std::to_string(count) + " vertices, but a triangle asks for number " +
           std::to_string(least < 0 ? least : most) + " (they count from 0).";
  }
  return {};
}

std::string material_fault(const TriangleMesh& mesh, const std::vector<Material>& materials) {
  if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= materials.size()) {
    return "asks for material " + std::to_string(mesh.material) + " of " + std::to_string(materials.size()) +
           " (they count from 0).";
  }
  const Material& material = materials[static_cast<std::size_t>(mesh.material)];
  if (!material.texture.empty() && mesh.uv.rows() == 0 && mesh.triangles.rows() != 0) {
    return "has no texture points, but its material '" + material.name + "' has a texture.";
  }
  return {};
}

}  // namespace

int Model::triangle_count() const {
  Eigen::Index count = 0;
  for (const TriangleMesh& mesh : meshes) count += mesh.triangles.rows();
  return static_cast<int>(count);
}

Eigen::AlignedBox3f Model::box() const {
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& mesh : meshes) {
    if (mesh.vertices.rows() == 0) continue;
    box.extend(mesh.vertices.colwise().minCoeff().transpose());
    box.extend(mesh.vertices.colwise().maxCoeff().transpose());
  }
  return box;
}

std::string Model::validate() const {
  for (const Material& material : materials) {
    if (const std::string fault = material.validate(); !fault.empty()) {
      return "Material '" + material.name + "' cannot be used: " + fault;
    }
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    std::string fault = mesh_fault(meshes[i]);
    if (fault.empty()) fault = material_fault(meshes[i], materials);
    if (!fault.empty()) return "Mesh " + std::to_string(i) + " of the model " + fault;
  }
  if (triangle_count() == 0) return "A model needs at least one triangle, found none.";
  return {};
}

void transform(Model& model, const Eigen::Transform<float, 3, Eigen::Affine>& world_from_model) {
  const Eigen::Matrix3f linear = world_from_model.linear();
  // The inverse transpose up to a factor, by columns of unit length: no scale makes it overflow.
  Eigen::Matrix3f axes = linear;
  axes.colwise().normalize();
  const bool mirrors = axes.determinant() < 0;
  Eigen::Matrix3f normal_from_normal;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f cofactors = axes.col((k + 1) % 3).cross(axes.col((k + 2) % 3));
    normal_from_normal.col(k) = (mirrors ? -1.0F : 1.0F) / linear.col(k).norm() * cofactors;
  }
  for (TriangleMesh& mesh : model.meshes) {
    mesh.vertices = (mesh.vertices * linear.transpose()).rowwise() + world_from_model.translation().transpose();
    mesh.normals = mesh.normals * normal_from_normal.transpose();
    mesh.normals.rowwise().normalize();
    // A mirror image would be inside out.
    if (mirrors) mesh.triangles.col(1).swap(mesh.triangles.col(2));
  }
}

void place(Model& model, const Placement& placement) {
  const Eigen::AlignedBox3f box = model.box();
  if (box.isEmpty() || !(box.sizes().y() > 0)) throw std::invalid_argument("A model without height cannot be placed.");
  if (!(placement.height_m > 0)) throw std::invalid_argument("A model must be placed with a height above 0.");
  const float length = placement.up.norm();
  if (!(length > 0)) throw std::invalid_argument("A model must be placed with an upward direction.");

  const Eigen::Vector3f up = placement.up / length;
  const Eigen::Vector3f underside(box.center().x(), box.min().y(), box.center().z());
  Eigen::Affine3f world_from_model = Eigen::Affine3f::Identity();
  world_from_model.translate(placement.foot_m);
  world_from_model.rotate(Eigen::AngleAxisf(placement.turn, up));
  world_from_model.rotate(Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitY(), up));
  world_from_model.scale(placement.height_m / box.sizes().y());
  world_from_model.translate(-underside);
  transform(model, world_from_model);
}

}  // namespace faceprobe::render

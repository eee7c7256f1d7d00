#include "assets/model_mesh.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/vertex_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace faceprobe::assets {
namespace {

constexpr float kMaxCoordinate = 1e9F;  // areas and their squares still fit a float

bool is_usable(const aiVector3D& v) {
  return std::abs(v.x) <= kMaxCoordinate && std::abs(v.y) <= kMaxCoordinate && std::abs(v.z) <= kMaxCoordinate;
}

void check_vertices(const ModelFile& file, const aiScene& scene) {
  std::int64_t bad = 0, all = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    all += mesh.mNumVertices;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) bad += is_usable(mesh.mVertices[i]) ? 0 : 1;
  }
  if (bad > 0) {
    file.refuse("has " + std::to_string(bad) + " of " + std::to_string(all) +
                " vertices that are no finite numbers up to 1e9. Export it again.");
  }
}

// Triangles that a mesh is cut into.
std::int64_t check_faces(const ModelFile& file, const aiMesh& mesh) {
  std::int64_t triangles = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    // assimp takes such a face for a polygon, and ends the program when cutting it up changes nothing.
    if (face.mNumIndices == 0) file.refuse("has a face without corners. Export it again.");
    if (face.mNumIndices > static_cast<unsigned>(kMaxCorners))
      file.check_count(face.mNumIndices, kMaxCorners, "corners in one face");
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) {
        file.refuse("names vertex " + std::to_string(face.mIndices[k]) + " in a face, and there are " +
                    std::to_string(mesh.mNumVertices) + ", counted from 0. Export it again.");
      }
    }
    triangles += face.mNumIndices > 2 ? face.mNumIndices - 2 : 0;
  }
  return triangles;
}

struct Counts {
  std::int64_t triangles = 0, vertices = 0, meshes = 0;
};

void count_copies(const ModelFile& file, const aiScene& scene, const aiNode& node,
                  const std::vector<std::int64_t>& triangles, Counts& counts) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const unsigned mesh = node.mMeshes[i];
    if (mesh >= scene.mNumMeshes) file.refuse("names a mesh that is not in it. Export it again.");
    counts.triangles += triangles[mesh];
    counts.vertices += scene.mMeshes[mesh]->mNumVertices;
    file.check_count(counts.triangles, file.limits.max_triangles, "triangles with all copies");
    file.check_count(counts.vertices, file.limits.max_vertices, "vertices with all copies");
    file.check_count(++counts.meshes, file.limits.max_parts, "meshes with all copies");
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) count_copies(file, scene, *node.mChildren[i], triangles, counts);
}

Eigen::Matrix4f matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4f matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

// Columns' cross products: turns normals as the inverse's transpose does, and exists for flat transforms too.
Eigen::Matrix3f cofactors(const Eigen::Matrix3f& m) {
  Eigen::Matrix3f out;
  for (int i = 0; i < 3; ++i) out.col(i) = m.col((i + 1) % 3).cross(m.col((i + 2) % 3));
  return out;
}

render::TriangleMesh read_mesh(const aiMesh& source, const Eigen::Matrix4f& world_from_mesh) {
  render::TriangleMesh mesh;
  const auto vertices = static_cast<Eigen::Index>(source.mNumVertices);
  mesh.vertices.resize(vertices, 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(source.mNumFaces), 3);
  for (Eigen::Index i = 0; i < vertices; ++i) {
    const aiVector3D& v = source.mVertices[i];
    mesh.vertices.row(i) = (world_from_mesh * Eigen::Vector4f(v.x, v.y, v.z, 1)).head<3>();
  }
  const bool mirrored = world_from_mesh.topLeftCorner<3, 3>().determinant() < 0;
  for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i) {
    const unsigned* corner = source.mFaces[i].mIndices;
    for (Eigen::Index k = 0; k < 3; ++k) mesh.triangles(i, mirrored ? 2 - k : k) = static_cast<int>(corner[k]);
  }
  mesh.material = static_cast<int>(source.mMaterialIndex);
  return mesh;
}

// As vertex_normals, but smooth where vertices were doubled for their texture points too.
Eigen::MatrixX3f normals_across_seams(const render::TriangleMesh& mesh) {
  std::vector<int> order(static_cast<std::size_t>(mesh.vertices.rows())), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::array{mesh.vertices(i, 0), mesh.vertices(i, 1), mesh.vertices(i, 2)}; };
  std::ranges::sort(order, [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  const Eigen::MatrixX3i triangles = mesh.triangles.unaryExpr([&](int i) { return first[static_cast<std::size_t>(i)]; });
  Eigen::MatrixX3f normals = vertex_normals<double>(mesh.vertices, triangles);
  for (std::size_t i = 0; i < first.size(); ++i) {
    normals.row(static_cast<Eigen::Index>(i)) = normals.row(first[i]).eval();
  }
  return normals;
}

void set_normals(const aiMesh& source, const Eigen::Matrix3f& world_from_mesh, render::TriangleMesh& mesh) {
  Eigen::Matrix3f turn = cofactors(world_from_mesh);
  if (world_from_mesh.determinant() < 0) turn = -turn;
  mesh.normals.setZero(mesh.vertices.rows(), 3);
  bool all = source.mNormals != nullptr;
  for (Eigen::Index i = 0; i < mesh.normals.rows() && source.mNormals != nullptr; ++i) {
    const aiVector3D& n = source.mNormals[i];
    const Eigen::Vector3f normal = (turn * Eigen::Vector3f(n.x, n.y, n.z)).stableNormalized();
    if (normal.allFinite() && std::abs(normal.norm() - 1) < 1e-3F)
      mesh.normals.row(i) = normal;
    else
      all = false;
  }
  if (all) return;
  const Eigen::MatrixX3f smooth = normals_across_seams(mesh);
  for (Eigen::Index i = 0; i < smooth.rows(); ++i) {
    if (mesh.normals.row(i).isZero()) mesh.normals.row(i) = smooth.row(i);
  }
}

// The number of texture points that are no finite numbers; they become 0.
int set_uv(const aiMesh& source, render::TriangleMesh& mesh) {
  if (!source.HasTextureCoords(0)) return 0;
  int bad = 0;
  mesh.uv.setZero(mesh.vertices.rows(), 2);
  for (Eigen::Index i = 0; i < mesh.uv.rows(); ++i) {
    const aiVector3D& point = source.mTextureCoords[0][i];
    if (is_usable({point.x, point.y, 0}))
      mesh.uv.row(i) << point.x, point.y;
    else
      ++bad;
  }
  return bad;
}

}  // namespace

void check_scene(const ModelFile& file, const aiScene& scene) {
  check_vertices(file, scene);
  std::vector<std::int64_t> triangles;
  std::int64_t all = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) all += triangles.emplace_back(check_faces(file, *scene.mMeshes[i]));
  if (all == 0 || scene.mRootNode == nullptr) {
    file.refuse("holds no triangles, only points, lines or nothing. A surface is needed.");
  }
  Counts counts;
  count_copies(file, scene, *scene.mRootNode, triangles, counts);
}

std::vector<render::TriangleMesh> read_meshes(const ModelFile& file, const aiScene& scene,
                                              std::vector<std::string>& warnings) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    check_faces(file, mesh);
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
      if (mesh.mFaces[k].mNumIndices != 3)
        file.refuse("has faces that could not be cut into triangles. Export it triangulated.");
    }
  }
  std::vector<render::TriangleMesh> meshes;
  int bad_points = 0;
  const auto visit = [&](const auto& self, const aiNode& node, const Eigen::Matrix4f& parent) -> void {
    const Eigen::Matrix4f world = parent * matrix_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
      meshes.push_back(read_mesh(source, world));
      if (!(meshes.back().vertices.array().abs() <= kMaxCoordinate).all()) {
        file.refuse(
            "has vertices that its nodes move to where numbers are not finite, or beyond 1e9. Export it again.");
      }
      set_normals(source, world.topLeftCorner<3, 3>(), meshes.back());
      bad_points += set_uv(source, meshes.back());
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) self(self, *node.mChildren[i], world);
  };
  visit(visit, *scene.mRootNode, Eigen::Matrix4f::Identity());
  if (bad_points > 0) {
    warnings.push_back(file.name + " has " + std::to_string(bad_points) +
                       " texture points that are no finite numbers; they count as 0.");
  }
  return meshes;
}

void take_vertex_colours(const ModelFile& file, const aiScene& scene, bool encoded, LoadedModel& loaded) {
  std::vector<render::Material>& materials = loaded.model.materials;
  for (const render::Material& material : materials) {
    if (!material.texture.empty()) return;
  }
  std::vector<Eigen::Vector4d> sums(materials.size(), Eigen::Vector4d::Zero());
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (!mesh.HasVertexColors(0) || mesh.mMaterialIndex >= sums.size()) continue;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiColor4D& c = mesh.mColors[0][i];
      if (!std::isfinite(c.r + c.g + c.b)) continue;
      Eigen::Vector3f colour = Eigen::Vector3f(c.r, c.g, c.b).cwiseMax(0).cwiseMin(1);
      if (encoded) colour = colour.unaryExpr([](float code) { return linear_from_srgb(code); });
      sums[mesh.mMaterialIndex] += Eigen::Vector4d(colour.x(), colour.y(), colour.z(), 1);
    }
  }
  bool any = false;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].w() <= 0) continue;
    any = true;
    const Eigen::Vector3f mean = (sums[i].head<3>() / sums[i].w()).cast<float>();
    materials[i].colour = encoded ? mean : Eigen::Vector3f(materials[i].colour.cwiseProduct(mean));
  }
  if (any) loaded.warnings.push_back(file.name + " has colours at its vertices; their mean is used.");
}

}  // namespace faceprobe::assets

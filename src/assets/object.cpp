#include "faceprobe/assets/object.h"

#include "assets/obj_file.h"
#include "faceprobe/core/vertex_normals.h"

#include <utility>

namespace faceprobe::assets {

synth::SurfaceMesh load_object(const std::filesystem::path& path) {
  ObjFile file = read_obj(path);
  synth::SurfaceMesh mesh;
  mesh.material = synth::Material::kObject;
  mesh.normals = vertex_normals(file.vertices, file.triangles);
  mesh.vertices = std::move(file.vertices);
  mesh.triangles = std::move(file.triangles);
  mesh.uv = std::move(file.uv);
  mesh.triangle_uv = std::move(file.triangle_uv);
  return mesh;
}

}  // namespace faceprobe::assets

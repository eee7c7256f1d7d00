#include "faceprobe/assets/model.h"

#include "assets/model_checks.h"
#include "assets/model_folder.h"
#include "assets/model_material.h"
#include "assets/model_mesh.h"
#include "faceprobe/io/data_files.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <map>
#include <optional>

namespace faceprobe::assets {
namespace {

namespace fs = std::filesystem;

// Not GenSmoothNormals and PreTransformVertices: assimp 5.2 gives a vertex that faces share the last one's normal, and leaves
// triangles turned over where a node mirrors them (model_mesh.cpp).
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;

std::optional<ModelFormat> format_of(const fs::path& path) {
  static const std::map<std::string, ModelFormat> kFormats = {{".obj", ModelFormat::kObj},
                                                              {".ply", ModelFormat::kPly},
                                                              {".gltf", ModelFormat::kGltf},
                                                              {".glb", ModelFormat::kGlb},
                                                              {".stl", ModelFormat::kStl}};
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = kFormats.find(extension);
  if (found == kFormats.end()) return std::nullopt;
  return found->second;
}

ModelFormat accept_path(const ModelFile& file) {
  std::error_code problem;
  const fs::file_status status = fs::status(file.path, problem);
  if (status.type() == fs::file_type::not_found) file.refuse("is not there; name an OBJ, PLY, glTF, GLB or STL file.");
  if (fs::is_directory(status)) file.refuse("is a folder, not a file. Name the model in it.");
  if (!fs::is_regular_file(status)) file.refuse("cannot be read; only regular files are.");
  const std::optional<ModelFormat> format = format_of(file.path);
  if (!format) file.refuse("has an unknown extension; .obj, .ply, .gltf, .glb and .stl are read. Convert it.");
  const auto bytes = static_cast<std::int64_t>(fs::file_size(file.path, problem));
  if (problem) file.refuse("cannot be read: " + problem.message() + ".");
  if (bytes == 0) file.refuse("is empty. Copy or download it again.");
  file.check_count(bytes, file.limits.max_file_bytes, "bytes");
  return *format;
}

// What assimp is to read in place of the file; empty for the file itself.
std::vector<std::byte> accept_content(const ModelFile& file, ModelFormat format, std::vector<std::string>& warnings) {
  if (format == ModelFormat::kObj) {
    check_obj(file);
    return {};
  }
  std::vector<std::byte> bytes = io::read_file(file.path, file.limits.max_file_bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (format == ModelFormat::kPly) return clean_ply(file, text);
  if (format != ModelFormat::kStl) return clean_gltf(file, bytes, format == ModelFormat::kGlb, warnings);
  check_stl(file, text);
  return bytes;
}

// Reads without any step first, so that what the steps believe can be checked.
const aiScene& import(Assimp::Importer& importer, const ModelFile& file, const FolderIo& io) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(file.path.string(), 0);
  if (!io.refused().empty()) throw Error(ExitCode::kInput, io.refused());
  if (scene == nullptr)
    file.refuse("cannot be read as a model: " + std::string(importer.GetErrorString()) + ". Export it again.");
  check_scene(file, *scene);
  scene = importer.ApplyPostProcessing(kSteps);
  if (scene == nullptr)
    file.refuse("cannot be read as a model: " + std::string(importer.GetErrorString()) + ". Export it again.");
  return *scene;
}

LoadedModel load(const ModelFile& file) {
  LoadedModel loaded;
  const ModelFormat format = accept_path(file);
  const bool gltf = format == ModelFormat::kGltf || format == ModelFormat::kGlb;
  const std::vector<std::byte> bytes = accept_content(file, format, loaded.warnings);
  auto* io = new FolderIo(file, bytes, format == ModelFormat::kObj);
  Assimp::Importer importer;
  importer.SetIOHandler(io);  // owns it
  const aiScene& scene = import(importer, file, *io);
  for (const std::string& missing : io->missing()) {
    loaded.warnings.push_back(file.name + " names the file '" + missing + "', which is not there; it is drawn without.");
  }

  std::vector<bool> used(scene.mNumMaterials, false);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (scene.mMeshes[i]->mMaterialIndex < scene.mNumMaterials) used[scene.mMeshes[i]->mMaterialIndex] = true;
  }
  MaterialReader materials(file, format, scene, loaded.warnings);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    // assimp adds glTF's default last: a rough metal, which nobody means who names no material.
    const bool added = gltf && i + 1 == scene.mNumMaterials;
    if (!added) loaded.model.materials.push_back(materials.read(*scene.mMaterials[i], used[i]));
    if (added && used[i]) loaded.model.materials.emplace_back();
  }
  loaded.model.meshes = read_meshes(file, scene, loaded.warnings);
  take_vertex_colours(file, scene, format == ModelFormat::kPly, loaded);
  if (loaded.model.triangle_count() == 0)
    file.refuse("holds no triangles, only points, lines or nothing. A surface is needed.");
  if (const std::string problem = loaded.model.validate(); !problem.empty()) file.refuse("cannot be drawn: " + problem);
  return loaded;
}

}  // namespace

LoadedModel load_model(const fs::path& path, const ModelLimits& limits) {
  if (const std::string problem = limits.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const std::string name = std::string("'").append(path.string()) + "'";
  try {
    const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path());
    return load({folder / path.filename(), folder, name, limits});
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ExitCode::kInput, name + " cannot be read as a model: " + error.what() + ". Export it again.");
  }
}

}  // namespace faceprobe::assets

#pragma once
// Internal: assimp's materials as ours.

#include "assets/model_checks.h"

#include <assimp/scene.h>

namespace faceprobe::assets {

enum class ModelFormat { kObj, kPly, kGltf, kGlb, kStl };

// Textures count against max_texture_pixels, all calls together.
class MaterialReader {
 public:
  MaterialReader(const ModelFile& file, ModelFormat format, const aiScene& scene, std::vector<std::string>& warnings)
      : file_(file), format_(format), scene_(scene), warnings_(warnings) {}

  // Without `textures` none is read, for materials that no triangle has.
  render::Material read(const aiMaterial& source, bool textures);

 private:
  void read_gltf(const aiMaterial& source, bool textures, render::Material& material);
  void read_mtl(const aiMaterial& source, render::Material& material) const;
  // Linear, three channels; empty when the material has none of this kind.
  Image texture(const aiMaterial& source, aiTextureType type);
  Image decode(const std::string& name) const;

  const ModelFile& file_;
  ModelFormat format_;
  const aiScene& scene_;
  std::vector<std::string>& warnings_;
  std::int64_t pixels_ = 0;
};

}  // namespace faceprobe::assets

#include "assets/model_material.h"

#include "assets/model_folder.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/photo.h"
#include "io/photo_bytes.h"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <algorithm>
#include <cmath>

namespace faceprobe::assets {
namespace {

using render::Material;
using render::MaterialKind;

constexpr float kCoatRoughness = 0.6F;  // rougher coats look like none
constexpr float kShiny = 100;           // MTL's Ns
constexpr float kBright = 0.3F;         // MTL's Ks

float clamped(float value, float fallback) { return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : fallback; }

float number(const aiMaterial& source, const char* key, unsigned type, unsigned slot, float fallback) {
  float value = fallback;
  source.Get(key, type, slot, value);
  return std::isfinite(value) ? value : fallback;
}

Eigen::Vector3f colour_of(const aiMaterial& source, const char* key, unsigned type, unsigned slot, float fallback) {
  aiColor4D value(fallback, fallback, fallback, 1);
  source.Get(key, type, slot, value);
  return {clamped(value.r, fallback), clamped(value.g, fallback), clamped(value.b, fallback)};
}

// The mean code value of one channel: metal and roughness maps hold numbers, which the photo reader took for sRGB.
float mean_code(const Image& picture, int channel) {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) sum += srgb_from_linear(picture(x, y, channel));
  }
  return static_cast<float>(sum / static_cast<double>(picture.pixel_count()));
}

Image texels(const aiTexture& texture) {
  ByteImage codes(static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), 3);
  for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
    const aiTexel& texel = texture.pcData[i];
    std::uint8_t* pixel = codes.data() + 3 * i;
    pixel[0] = texel.r, pixel[1] = texel.g, pixel[2] = texel.b;
  }
  return decode_srgb(codes);
}

}  // namespace

Image MaterialReader::decode(const std::string& name) const {
  const io::Limits& limits = file_.limits.picture;
  if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str())) {
    if (inside->mHeight == 0) {
      const std::span bytes(reinterpret_cast<const std::byte*>(inside->pcData), inside->mWidth);
      return io::photo_from_bytes(bytes, "the picture in it", limits).linear;
    }
    file_.check_count(std::int64_t{inside->mWidth} * inside->mHeight, limits.max_pixels, "pixels in a texture");
    return texels(*inside);
  }
  const std::filesystem::path path = find_companion(file_, name, "the texture");
  if (path.empty()) {
    file_.refuse("names the texture '" + name +
                 "', which is not there; put it beside the model, or remove the reference.");
  }
  return io::load_photo(path, limits).linear;
}

Image MaterialReader::texture(const aiMaterial& source, aiTextureType type) {
  aiString name;
  if (source.GetTexture(type, 0, &name) != aiReturn_SUCCESS || name.length == 0) return {};
  Image picture;
  try {
    picture = decode(name.C_Str());
  } catch (const Error& error) {
    const std::string reason = error.what();
    if (reason.starts_with(file_.name)) throw;
    file_.refuse("names the texture '" + std::string(name.C_Str()) + "', which cannot be used: " + reason);
  }
  pixels_ += static_cast<std::int64_t>(picture.pixel_count());
  file_.check_count(pixels_, file_.limits.max_texture_pixels, "pixels in its textures");
  return picture;
}

void MaterialReader::read_gltf(const aiMaterial& source, bool textures, Material& material) {
  material.colour = colour_of(source, AI_MATKEY_BASE_COLOR, 1);
  float metal = clamped(number(source, AI_MATKEY_METALLIC_FACTOR, 1), 1);
  float rough = clamped(number(source, AI_MATKEY_ROUGHNESS_FACTOR, 1), 1);
  if (textures) {
    material.texture = texture(source, aiTextureType_BASE_COLOR);
    // The factors alone are 1 in most files, and the map says what is metal.
    const Image map = texture(source, aiTextureType_UNKNOWN);
    if (!map.empty()) {
      rough *= mean_code(map, 1);
      metal *= mean_code(map, 2);
      warnings_.push_back(file_.name + " has a map of metal and roughness in the material '" + material.name +
                          "'; its mean is used.");
    }
  }
  const float passes = number(source, AI_MATKEY_TRANSMISSION_FACTOR, 0);
  material.roughness = rough;
  if (passes > 0.5F) {
    material.kind = MaterialKind::kGlass;
  } else if (metal >= 0.5F) {
    material.kind = MaterialKind::kMetal;
  } else {
    material.kind = rough < kCoatRoughness ? MaterialKind::kPlastic : MaterialKind::kDiffuse;
  }
}

void MaterialReader::read_mtl(const aiMaterial& source, Material& material) const {
  material.colour = colour_of(source, AI_MATKEY_COLOR_DIFFUSE, 0.8F);
  const float shine = std::clamp(number(source, AI_MATKEY_SHININESS, 0), 0.0F, 1e6F);
  int light = 2;
  source.Get(AI_MATKEY_OBJ_ILLUM, light);
  const bool glossy = shine > kShiny || colour_of(source, AI_MATKEY_COLOR_SPECULAR, 0).mean() >= kBright;
  if (number(source, AI_MATKEY_OPACITY, 1) < 0.5F) {
    material.kind = MaterialKind::kGlass;
    const float index = number(source, AI_MATKEY_REFRACTI, 1.5F);
    if (index > 1.01F && index < 3) material.ior = index;  // 1 is what writers put who do not know
  } else if (glossy && light >= 2) {                       // illum 0 and 1 have no highlight
    material.kind = MaterialKind::kPlastic;
    material.roughness = std::pow(2 / (shine + 2), 0.25F);  // Blinn-Phong's exponent as GGX's alpha, whose root this is
  }
}

Material MaterialReader::read(const aiMaterial& source, bool textures) {
  Material material;
  aiString name;
  if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = name.C_Str();
  const bool gltf = format_ == ModelFormat::kGltf || format_ == ModelFormat::kGlb;
  if (gltf) {
    read_gltf(source, textures, material);
  } else if (format_ == ModelFormat::kObj && material.name != AI_DEFAULT_MATERIAL_NAME) {
    read_mtl(source, material);
    if (textures) material.texture = texture(source, aiTextureType_DIFFUSE);
    // Many writers put Kd 0 beside a map and mean the map alone.
    if (!material.texture.empty() && material.colour.maxCoeff() <= 0) material.colour.setOnes();
  }
  return material;
}

}  // namespace faceprobe::assets

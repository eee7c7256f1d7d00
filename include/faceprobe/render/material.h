#pragma once
// How the surface of a thing answers light; few kinds, each with one model that other renderers have too.
//
//   Material gold = material_preset("gold");
//   Material wood{.kind = MaterialKind::kPlastic, .texture = picture, .roughness = 0.3F};

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::render {

enum class MaterialKind {
  kDiffuse,  // Lambert
  kMetal,    // GGX lobe (Walter et al. 2007) under Schlick's Fresnel term, which goes from `colour` to white
  kPlastic,  // Lambert under a dielectric coat; the viewer's angle alone shares the light between the two, so that no energy is lost
  kGlass,  // smooth dielectric body: mirrors and refracts, exact Fresnel terms; `colour` tints what passes
};

struct Material {
  std::string name{};
  MaterialKind kind = MaterialKind::kDiffuse;
  Eigen::Vector3f colour =
      Eigen::Vector3f::Constant(0.8F);  // linear; albedo, or reflectance at normal incidence of a metal
  Image texture{};                      // linear, three channels, v up; multiplies colour; empty = none
  float roughness = 0;  // GGX alpha = roughness^2 (Burley 2012, as in glTF and Blender); below kSmooth an ideal mirror
  float ior = 1.5F;     // index of refraction: of a plastic's coat, of glass

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

inline constexpr float kSmooth = 0.03F;  // roughness

// "diffuse", "plastic" (the paper's hard shiny white plastic: index 1.362, smooth), "silver" (matte), "gold", "mirror", "glass", "clay",
// "red". Throws Error(kUsage) listing the names there are.
Material material_preset(std::string_view name);
const std::vector<std::string>& material_preset_names();

std::string_view material_kind_name(MaterialKind kind);  // "diffuse", "metal", "plastic", "glass"
// Throws Error(kUsage) listing the names there are.
MaterialKind material_kind_from_name(std::string_view name);
const std::vector<std::string>& material_kind_names();

// What is to be other than a material has it; what is unset stays.
//
//   const Material copper = changed(material_preset("gold"), {.colour = colour_from("#f4a080")});
struct MaterialChange {
  std::optional<MaterialKind> kind{};
  std::optional<Eigen::Vector3f> colour{};  // linear; in place of a texture, too
  std::optional<float> roughness{};
  std::optional<float> ior{};

  bool empty() const;  // whether nothing is to change
  // Empty when usable, else what Material::validate() says of a material that has these.
  std::string validate() const;
};
// The material with what is set in `change`.
Material changed(Material material, const MaterialChange& change);

// Linear colour of "#c02010", which is sRGB as on web pages, or of "0.5,0.02,0.01", which is linear already and may be out of range. Throws
// Error(kUsage) for other texts.
Eigen::Vector3f colour_from(std::string_view text);

}  // namespace faceprobe::render

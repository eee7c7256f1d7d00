#include "faceprobe/render/material.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace faceprobe::render {
namespace {

struct Preset {
  std::string_view name;
  MaterialKind kind;
  std::array<float, 3> colour;
  float roughness;
  float ior;
};

// Gold and silver: reflectances at normal incidence in linear Rec.709, table 9.2 of Akenine-Moeller et al., Real-Time Rendering, 4th
// edition. 0.8 is fresh white paint, 0.9 the whitest of plastics. Clay (terracotta) and red are chosen by eye.
constexpr std::array<Preset, 8> kPresets{{
    {"diffuse", MaterialKind::kDiffuse, {0.8F, 0.8F, 0.8F}, 0, 1.5F},
    {"plastic", MaterialKind::kPlastic, {0.9F, 0.9F, 0.9F}, 0, 1.362F},
    {"silver", MaterialKind::kMetal, {0.972F, 0.960F, 0.915F}, 0.45F, 1.5F},
    {"gold", MaterialKind::kMetal, {1.0F, 0.782F, 0.344F}, 0.25F, 1.5F},
    {"mirror", MaterialKind::kMetal, {1, 1, 1}, 0, 1.5F},
    {"glass", MaterialKind::kGlass, {1, 1, 1}, 0, 1.5F},
    {"clay", MaterialKind::kDiffuse, {0.50F, 0.21F, 0.12F}, 0, 1.5F},
    {"red", MaterialKind::kPlastic, {0.60F, 0.03F, 0.02F}, 0.2F, 1.5F},
}};

constexpr std::array<std::pair<MaterialKind, std::string_view>, 4> kKinds{{
    {MaterialKind::kDiffuse, "diffuse"},
    {MaterialKind::kMetal, "metal"},
    {MaterialKind::kPlastic, "plastic"},
    {MaterialKind::kGlass, "glass"},
}};

// The whole of a text as a number.
template <class Number, class... Format>
bool reads(std::string_view text, Number& number, Format... format) {
  const char* const end = text.data() + text.size();
  const auto [rest, problem] = std::from_chars(text.data(), end, number, format...);
  return problem == std::errc() && rest == end;
}

// Not so for NaN either.
bool within(float value, float low, float high) { return value >= low && value <= high; }

}  // namespace

std::string Material::validate() const {
  for (const float value : colour) {
    if (!within(value, 0, 1)) return "A material's colour must be from 0 to 1, found " + std::to_string(value) + ".";
  }
  if (!within(roughness, 0, 1)) {
    return "A material's roughness must be from 0 to 1, found " + std::to_string(roughness) + ".";
  }
  if (!within(ior, 1, 3)) {
    return "A material's index of refraction must be from 1 to 3, found " + std::to_string(ior) + ".";
  }
  if (!texture.empty() && texture.channels() != 3) {
    return "A material's texture must have 3 channels, found " + std::to_string(texture.channels()) + ".";
  }
  return {};
}

Material material_preset(std::string_view name) {
  const auto* const found =
      std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& p) { return p.name == name; });
  if (found == kPresets.end())
    throw Error(ExitCode::kUsage, "There is no material called '" + std::string(name) + "'; take one of " +
                                      listed(material_preset_names()) + ".");
  Material material;
  material.name = found->name;
  material.kind = found->kind;
  material.colour = Eigen::Vector3f(found->colour[0], found->colour[1], found->colour[2]);
  material.roughness = found->roughness;
  material.ior = found->ior;
  return material;
}

const std::vector<std::string>& material_preset_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    list.reserve(kPresets.size());
    for (const Preset& preset : kPresets) list.emplace_back(preset.name);
    return list;
  }();
  return names;
}

std::string_view material_kind_name(MaterialKind kind) {
  const auto* const found = std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.first == kind; });
  if (found == kKinds.end()) throw std::invalid_argument("This is no kind of material.");
  return found->second;
}

MaterialKind material_kind_from_name(std::string_view name) {
  const auto* const found = std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.second == name; });
  if (found == kKinds.end())
    throw Error(ExitCode::kUsage, "There is no kind of material called '" + std::string(name) + "'; take one of " +
                                      listed(material_kind_names()) + ".");
  return found->first;
}

const std::vector<std::string>& material_kind_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    list.reserve(kKinds.size());
    for (const auto& kind : kKinds) list.emplace_back(kind.second);
    return list;
  }();
  return names;
}

bool MaterialChange::empty() const { return !kind && !colour && !roughness && !ior; }

std::string MaterialChange::validate() const { return changed({}, *this).validate(); }

Material changed(Material material, const MaterialChange& change) {
  material.kind = change.kind.value_or(material.kind);
  material.roughness = change.roughness.value_or(material.roughness);
  material.ior = change.ior.value_or(material.ior);
  if (change.colour) {
    material.colour = *change.colour;
    material.texture = {};
  }
  return material;
}

Eigen::Vector3f colour_from(std::string_view text) {
  const auto refused = [whole = std::string(text)] {
    return Error(ExitCode::kUsage,
                 "A colour is R,G,B of linear light, from 0 to 1, or #rrggbb as on web pages; found '" + whole + "'.");
  };
  Eigen::Vector3f colour;
  if (text.starts_with('#')) {
    if (text.size() != 7) throw refused();
    for (int c = 0; c < 3; ++c) {
      unsigned byte = 0;
      if (!reads(text.substr(1 + 2 * static_cast<std::size_t>(c), 2), byte, 16)) throw refused();
      colour[c] = linear_from_srgb(static_cast<float>(byte) / 255);
    }
    return colour;
  }
  for (int c = 0; c < 3; ++c) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (c == 2) || !reads(text.substr(0, comma), colour[c])) throw refused();
    if (c < 2) text.remove_prefix(comma + 1);
  }
  return colour;
}

}  // namespace faceprobe::render

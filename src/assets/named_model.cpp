#include "faceprobe/assets/named_model.h"

#include "faceprobe/core/error.h"
#include "faceprobe/render/shapes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace faceprobe::assets {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

using Kind = render::MaterialKind;

void change_materials(const render::MaterialChange& change, std::vector<render::Material>& materials) {
  if (const std::string fault = change.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  for (render::Material& material : materials) material = render::changed(std::move(material), change);
  const auto any_is = [&](Kind one, Kind other) {
    return std::ranges::any_of(materials, [&](const auto& m) { return m.kind == one || m.kind == other; });
  };
  if (change.roughness && !any_is(Kind::kMetal, Kind::kPlastic)) {
    throw Error(
        ExitCode::kUsage,
        "Roughness shows on metal and plastic, and the object is of neither; choose one of these kinds for it.");
  }
  if (change.ior && !any_is(Kind::kPlastic, Kind::kGlass)) {
    throw Error(ExitCode::kUsage,
                "An index of refraction shows in plastic and glass, and the object is of neither; choose one of these "
                "kinds for it.");
  }
}

}  // namespace

LoadedModel model_named(const std::filesystem::path& object, const std::string& material,
                        const render::MaterialChange& change, const ModelLimits& limits) {
  const std::vector<std::string>& shapes = render::shape_names();
  std::optional<render::Material> preset;  // before the file is read: a typing error should not cost that
  if (!material.empty()) preset = render::material_preset(material);
  LoadedModel loaded;
  if (is_among(shapes, object.string())) {
    loaded.model = render::shape(object.string());
  } else if (object.extension().empty()) {
    throw Error(ExitCode::kUsage, "There is no object called '" + object.string() + "'; take one of " + listed(shapes) +
                                      ", or name an OBJ, PLY, STL, glTF or GLB file.");
  } else {
    loaded = load_model(object, limits);
  }
  if (preset) {
    loaded.model.materials = {*std::move(preset)};
    for (render::TriangleMesh& mesh : loaded.model.meshes) mesh.material = 0;
  }
  if (!change.empty()) change_materials(change, loaded.model.materials);
  return loaded;
}

}  // namespace faceprobe::assets

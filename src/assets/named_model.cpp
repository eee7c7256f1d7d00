#include "faceprobe/assets/named_model.h"

#include "faceprobe/core/error.h"
#include "faceprobe/render/shapes.h"

#include <algorithm>

namespace faceprobe::assets {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

LoadedModel model_named(const std::filesystem::path& object, const std::string& material, const ModelLimits& limits) {
  const std::vector<std::string>& shapes = render::shape_names();
  const std::vector<std::string>& presets = render::material_preset_names();
  if (!material.empty() && !is_among(presets, material))
    throw Error(ExitCode::kUsage,
                "There is no material called '" + material + "'; take one of " + listed(presets) + ".");
  LoadedModel loaded;
  if (is_among(shapes, object.string())) {
    loaded.model = render::shape(object.string());
  } else if (object.extension().empty()) {
    throw Error(ExitCode::kUsage, "There is no object called '" + object.string() + "'; take one of " + listed(shapes) +
                                      ", or name an OBJ, PLY, STL, glTF or GLB file.");
  } else {
    loaded = load_model(object, limits);
  }
  if (material.empty()) return loaded;
  loaded.model.materials = {render::material_preset(material)};
  for (render::TriangleMesh& mesh : loaded.model.meshes) mesh.material = 0;
  return loaded;
}

}  // namespace faceprobe::assets

#include "object_choice.h"

#include "faceprobe/assets/model.h"
#include "faceprobe/core/error.h"
#include "faceprobe/render/shapes.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace faceprobe::cli {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

render::Model object_named(const std::string& object, const std::string& material) {
  const std::vector<std::string>& shapes = render::shape_names();
  const std::vector<std::string>& presets = render::material_preset_names();
  if (!material.empty() && std::find(presets.begin(), presets.end(), material) == presets.end())
    throw Error(ExitCode::kUsage,
                "There is no material called '" + material + "'; take one of " + listed(presets) + ".");
  render::Model model;
  if (std::find(shapes.begin(), shapes.end(), object) != shapes.end()) {
    model = render::shape(object);
  } else if (std::filesystem::path(object).extension().empty()) {
    throw Error(ExitCode::kUsage, "There is no object called '" + object + "'; take one of " + listed(shapes) +
                                      ", or name an OBJ, PLY, STL, glTF or GLB file.");
  } else {
    assets::LoadedModel loaded = assets::load_model(object);
    for (const std::string& warning : loaded.warnings) spdlog::warn("{}: {}", object, warning);
    model = std::move(loaded.model);
  }
  if (material.empty()) return model;
  model.materials = {render::material_preset(material)};
  for (render::TriangleMesh& mesh : model.meshes) mesh.material = 0;
  return model;
}

}  // namespace faceprobe::cli

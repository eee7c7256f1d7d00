#pragma once
// The thing that a user names: one of the shapes made in code (render/shapes.h), or a file (assets/model.h).
//
//   const assets::LoadedModel pot = assets::model_named("pot", "silver");
//   const assets::LoadedModel rough = assets::model_named("pot", "silver", {.roughness = 0.7F});

#include "faceprobe/assets/model.h"

#include <filesystem>
#include <string>

namespace faceprobe::assets {

// `material`: a preset (render/material.h) for all of it in place of its own; empty = its own. `change`: of what it is then made of. Throws
// Error(kUsage) for a name that is no shape's and has no extension, for a material that is none, and for a change that does not validate or
// that would show in none of its materials, such as roughness of glass; Error(kInput) as load_model.
LoadedModel model_named(const std::filesystem::path& object, const std::string& material = "",
                        const render::MaterialChange& change = {}, const ModelLimits& limits = {});

}  // namespace faceprobe::assets

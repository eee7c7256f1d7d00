#pragma once
// What both renderers draw: a thing on a grey card, in one of five materials, as a photo taken from a little above would show it.

#include "faceprobe/render/path_tracer.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

// The materials whose models are the same in both: render/material.h, and what Blender's nodes make of them.
struct TestMaterial {
  std::string name;  // in the tables, and Blender's kind: "diffuse", "metal", "mirror", "plastic", "glass"
  render::Material ours;
};
const std::vector<TestMaterial>& test_materials();

// `object`, empty = a pot made in code. Meshes of the thing have material 0, the card is the last mesh and has material 1.
// Throws Error(kInput) as assets::load_model() does.
render::Model stand_on_card(const std::filesystem::path& object, const render::Material& material);

render::PinholeView scene_view(int size_px);

}  // namespace faceprobe::bench

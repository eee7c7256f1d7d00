#pragma once
// An estimated light as scenes of other tools: their own text files beside the map, so that nobody has to know our axes.
//
//   write(folder / "light.usda", usd_scene(light, "environment_rest.exr"));
//
// Both have the strongest main light as a lamp of its own, sharp, and the rest of the light as a map: `environment_rest.exr`, in OpenEXR's
// columns. A light without main lights has no lamp. The portrait's camera stands at the origin.

#include "faceprobe/pipeline/estimate.h"

#include <string>

namespace faceprobe::pipeline {

// The map without the lamp that the scenes have beside it (lighting::without_main_lights of the strongest one). `options`: those of
// the estimate.
EnvMap rest_of_environment(const LightResult& light, const EstimateOptions& options);

// Universal Scene Description, text: a dome light, a distant light, +y up, metres. `map_file` as seen from the scene's folder.
std::string usd_scene(const LightResult& light, const std::string& map_file);

// Python for Blender, to be run from its text editor or by `blender --python blender.py`: sets up the world and a sun, +z up, the
// portrait's camera looking along +y. The map is looked for in the script's folder.
std::string blender_script(const LightResult& light, const std::string& map_file);

}  // namespace faceprobe::pipeline

#pragma once
// An estimated light as scenes of other tools: their own text files beside the map, so that nobody has to know our axes.
//
//   write(folder / "light.usda", usd_scene(light, "environment_rest.exr"));
//
// All have the strongest main light as a lamp of its own, sharp, and the rest of the light as a map: `environment_rest.exr`, in OpenEXR's
// columns, or cube maps of it within the file. A light without main lights has no lamp. The portrait's camera stands at the origin.

#include "faceprobe/pipeline/estimate.h"

#include <Eigen/Core>
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

// glTF 2.0, text, that needs no other file: EXT_lights_image_based with `rest` (rest_of_environment()) as cube maps, 64 texels wide at most, in RGBD,
// and as irradiance; KHR_lights_punctual with the lamp. There is nothing in it to look at. The frame is the camera's. Under 100 kB.
std::string gltf_scene(const LightResult& light, const EnvMap& rest);

// Nine radiance coefficients (core/sh.h; more are left out) as EXT_lights_image_based has them, 9 x 3: of irradiance, not divided by pi, with the
// Condon-Shortley sign and in the axes of the cube map, whose x is minus ours. The extension's text leaves both open; this is how Babylon.js reads
// it. Throws std::invalid_argument for fewer than nine.
Eigen::MatrixX3d gltf_irradiance_coefficients(const Eigen::MatrixX3d& radiance);

}  // namespace faceprobe::pipeline

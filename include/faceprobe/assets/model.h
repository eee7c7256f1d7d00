#pragma once
// A thing to be drawn, from a file: Wavefront OBJ, PLY, glTF 2.0 (.gltf, .glb) and STL, through assimp, with its materials and
// base-colour textures. Not for heads (assets/heads.h), and not for what is lit without being drawn (assets/object.h).
//
//   assets::LoadedModel pot = assets::load_model("pot.glb");
//   render::place(pot.model, {.height_m = 0.2F, .foot_m = {0.1F, -0.15F, -0.6F}});
//
// Lengths are the file's, which seldom says its unit: place() gives the thing its size. Axes are the file's too; OBJ and glTF
// are +y up, scans and prints in PLY and STL often lie down. Animations, skins, cameras and lights are left out.

#include "faceprobe/io/limits.h"
#include "faceprobe/render/model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::assets {

struct ModelLimits {
  std::int64_t max_file_bytes = 512LL << 20;      // of the file, and of all it names together, pictures apart
  int max_triangles = 5'000'000;                  // of the scene, with every copy that its nodes make
  int max_vertices = 15'000'000;                  // as above
  int max_parts = 10'000;                         // meshes, nodes, materials, groups, each
  std::int64_t max_texture_pixels = 100'000'000;  // of all materials together
  io::Limits picture = {};                        // of each texture

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

struct LoadedModel {
  render::Model model;                // validates
  std::vector<std::string> warnings;  // sentences for the report: what could not be kept
};

// Materials, all taken as linear, MTL's Kd too: glTF's are metal (metallic >= .5), glass (transmission > .5), plastic (roughness
// < .6) or diffuse; MTL's are glass (d < .5), plastic (Ns > 100, or Ks >= .3 on average) or diffuse. The first set of texture
// points counts. Without any texture, the mean of the vertex colours is the colour.
//
// The file may come from a stranger. Counts are judged by our own parsers before assimp is called, and companions (.mtl, .bin,
// textures) are read from the file's own folder and below only.
//
// Throws Error(kInput): missing, empty, not of these kinds, cut short, over a limit, coordinates that are no finite numbers,
// no triangles, a texture that is missing, unreadable or outside the folder; Error(kUsage) for limits that do not validate.
LoadedModel load_model(const std::filesystem::path& path, const ModelLimits& limits = {});

}  // namespace faceprobe::assets

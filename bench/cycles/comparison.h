#pragma once
// The same faces by our renderer and by Cycles, and how far they are apart.

#include "cycles/blender.h"
#include "cycles/fast.h"
#include "cycles/maps.h"
#include "faceprobe/synth/map_light.h"
#include "faceprobe/synth/transport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

inline constexpr float kLobeRoughness = 0.3F;

struct ComparisonOptions {
  std::filesystem::path data;
  std::filesystem::path folder = "out/synth_cycles";
  std::string blender = "blender";
  int maps = 8;
  int size_px = 256;
  int samples = 1024;      // Cycles', per pixel
  int check_pixels = 400;  // summed by brute force
  int nside = 16;
  int images_per_view = 64;
  int threads = 0;
};

// One layer of one map; relative RMSE over the face.
struct LayerErrors {
  double noise = 0;  // of the reference itself, from two renders with different seeds
  double ours = 0;   // our renderer against Cycles, all pixels of the face; specular with F = 1 on both sides
  double own_lobe =
      0;  // specular of skin: our renderer against Cycles x (sum with our lobe / sum with Cycles' lobe), check pixels
  double sum_cycles = 0;  // brute-force sum with Cycles' lobe against Cycles, check pixels
  double ours_sum = 0;    // our renderer against the brute-force sum with our lobe, check pixels
};

struct MapComparison {
  NamedMap map;
  synth::MapLight light;
  std::filesystem::path file;  // as Blender reads it
  FastPicture skin;            // F0 of skin, rho_s = 1
  FastPicture metal;           // F = 1, rho_s = 1/4: what Cycles' lobe is but for its shadowing term
  Image cycles_diffuse, cycles_glossy;
  LayerErrors diffuse, glossy;
};

struct Comparison {
  synth::SurfaceMesh head;  // scene's frame
  synth::PinholeCamera camera;
  CyclesSetup cycles;
  std::vector<int> face;  // pixels (y * width + x) that are skin of the face in both, 2 px inside its edge
  std::vector<MapComparison> maps;
  MapComparison lamp;  // a red lamp at camera right
};

synth::TransportOptions transport_options(const ComparisonOptions& options);

// Renders everything. Throws Error as load_head(), load_maps() and render_with_cycles() do.
Comparison compare_with_cycles(const ComparisonOptions& options);

}  // namespace faceprobe::bench

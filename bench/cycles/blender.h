#pragma once
// Pictures by Blender's Cycles, run as a program of its own.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct CyclesSetup {
  std::string blender = "blender";
  std::filesystem::path folder;  // for the job, the maps, the pictures and Blender's log
  synth::SurfaceMesh mesh_cam;   // camera frame
  synth::PinholeCamera camera;   // principal point in the middle
  float alpha = 0.3F;            // Beckmann's m
  int threads = 0;               // 0 = all
};

struct CyclesRender {
  std::filesystem::path map;  // by write_map_for_blender()
  int samples = 1024;
  int seed = 0;
  float light_threshold = 0;  // Cycles' "light threshold": dim lights are then taken at random; unbiased
};

struct CyclesPicture {
  Image diffuse;       // 3 channels: radiance of a white Lambertian surface under direct light
  Image glossy;        // 3 channels: radiance of the Beckmann lobe, no Fresnel term
  Image coverage;      // 1 channel
  double seconds = 0;  // as the renderer spent them: start-up and files excluded
};

// 32-bit EXR in Blender's convention of columns.
void write_map_for_blender(const std::filesystem::path& path, const EnvMap& map);

// One picture per render. Throws Error(kModel) when Blender cannot be run or fails; the log's name is in the sentence.
std::vector<CyclesPicture> render_with_cycles(const CyclesSetup& setup, const std::vector<CyclesRender>& renders);

}  // namespace faceprobe::bench

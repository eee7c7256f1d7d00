#pragma once
// Pictures of a model by Blender's Cycles, run as a program of its own: every bounce, the background left out.

#include "faceprobe/core/image.h"
#include "insert_cycles/maps.h"
#include "insert_cycles/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct CyclesJob {
  std::string blender = "blender";
  std::filesystem::path folder;  // for the job, the maps, the pictures and Blender's log
  int threads = 2;
  int max_bounces = 12;  // as render::RenderOptions counts: surfaces along a path
  int size_px = 256;
};

struct CyclesShot {
  std::size_t map = 0;  // index into `maps`; shots of one map in a row
  int samples = 1024;
  int seed = 0;
};

struct TimedPicture {
  Image picture;           // 4 channels, premultiplied
  double seconds = 0;      // with the ray-tracing structure built, without start-up and files
  double cpu_seconds = 0;  // of all threads; Cycles' of the render alone
};

// One picture per shot. Throws Error(kModel) when Blender fails; the log's name is in the sentence.
std::vector<TimedPicture> render_with_cycles(const CyclesJob& job, const render::Model& model,
                                             const TestMaterial& material, const std::vector<TestMap>& maps,
                                             const std::vector<CyclesShot>& shots);

}  // namespace faceprobe::bench

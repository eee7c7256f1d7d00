// Models to be drawn: OBJ, PLY, STL and glTF, our own checks and what assimp then meets. The first byte picks the kind. assimp
// reads files by name, so each input is one; put $TMPDIR on a memory file system.

#include "faceprobe/assets/model.h"
#include "faceprobe/core/error.h"

#include <unistd.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const char* const kExtensions[] = {".obj", ".ply", ".gltf", ".glb", ".stl"};
  // A folder of its own: companions are read from there.
  static const std::filesystem::path kFolder =
      std::filesystem::temp_directory_path() / ("faceprobe_fuzz_model_" + std::to_string(::getpid()));
  std::filesystem::create_directories(kFolder);
  const std::filesystem::path path = kFolder / (std::string("a") + kExtensions[data[0] % 5]);
  {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  }
  try {
    // Low enough that our own limits refuse a model before the fuzzer's memory limit stops the run.
    faceprobe::assets::ModelLimits limits;
    limits.max_triangles = 1 << 14;
    limits.max_vertices = 1 << 15;
    limits.max_parts = 200;
    limits.picture.max_pixels = 1 << 18;
    limits.picture.expansion_free_bytes = 8 << 20;
    faceprobe::assets::load_model(path, limits);
  } catch (const faceprobe::Error&) {  // the only exception that may leave the room
  }
  return 0;
}

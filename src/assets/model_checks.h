#pragma once
// Internal: what a model file says about itself, read by our own parsers before assimp is called. assimp 5 allocates what a
// header claims and trusts many of the indices that it reads, so both are judged first.

#include "faceprobe/assets/model.h"
#include "faceprobe/core/error.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::assets {

inline constexpr int kMaxCorners = 1000;  // of a polygon; cutting one into triangles takes the square of it

// Everything that a check needs to refuse.
struct ModelFile {
  std::filesystem::path path;    // absolute
  std::filesystem::path folder;  // canonical: what companions must lie in
  std::string name;              // for sentences
  const ModelLimits& limits;

  [[noreturn]] void refuse(const std::string& sentence) const { throw Error(ExitCode::kInput, name + " " + sentence); }
  // Refuses when found > allowed. `what`: "triangles".
  void check_count(std::int64_t found, std::int64_t allowed, const std::string& what) const;
};

// Streams the file; its size does not matter.
void check_obj(const ModelFile& file);
// The statements of an .mtl that count here, from the first newmtl on: assimp 5.2 writes to no material before that.
std::vector<std::byte> clean_mtl(std::string_view text);
void check_stl(const ModelFile& file, std::string_view bytes);
// The file with its header written anew: assimp reads the same elements from it as the check did.
std::vector<std::byte> clean_ply(const ModelFile& file, std::string_view bytes);
// The file with what is drawn only; what is left out for good adds a warning.
std::vector<std::byte> clean_gltf(const ModelFile& file, std::span<const std::byte> bytes, bool binary,
                                  std::vector<std::string>& warnings);

}  // namespace faceprobe::assets

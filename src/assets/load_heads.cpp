#include "assets/array.h"
#include "assets/folder.h"
#include "assets/ict_source.h"
#include "faceprobe/assets/heads.h"

#include <algorithm>

namespace faceprobe::assets {
namespace {

synth::HeadModel load_file(const std::filesystem::path& path) {
  if (path.extension() == ".obj") return load_obj_head(path);
  return load_basel_head(path);
}

void add_folder(const std::filesystem::path& folder, std::vector<synth::HeadModel>& heads) {
  if (has_ict_arrays(folder) || has_ict_objs(folder)) {
    heads.push_back(load_ict_head(folder));
    return;
  }
  for (const std::filesystem::path& file : files_in(folder, {".mat", ".h5", ".obj"})) heads.push_back(load_file(file));
}

}  // namespace

std::vector<synth::HeadModel> load_heads(const std::filesystem::path& path) {
  std::vector<synth::HeadModel> heads;
  if (std::filesystem::is_regular_file(path)) {
    heads.push_back(load_file(path));
    return heads;
  }
  add_folder(path, heads);
  if (heads.empty()) {
    std::vector<std::filesystem::path> folders;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      if (entry.is_directory()) folders.push_back(entry.path());
    }
    std::ranges::sort(folders);
    for (const std::filesystem::path& folder : folders) add_folder(folder, heads);
  }
  if (heads.empty()) {
    refuse_input(
        quoted(path) +
        " holds no head model; known are an ICT-FaceKit folder, Basel Face Models (.mat, .h5) and .obj files.");
  }
  return heads;
}

}  // namespace faceprobe::assets

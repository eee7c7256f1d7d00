#include "assets/folder.h"

#include "assets/array.h"

#include <algorithm>
#include <cctype>

namespace faceprobe::assets {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            std::initializer_list<std::string_view> extensions) {
  std::error_code problem;
  if (!std::filesystem::is_directory(folder, problem)) {
    refuse_input(quoted(folder) + " is not a folder that can be read; name one.");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    std::string extension = entry.path().extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::ranges::find(extensions, std::string_view(extension)) != extensions.end()) files.push_back(entry.path());
  }
  if (problem) refuse_input(quoted(folder) + " cannot be read: " + problem.message() + ".");
  std::ranges::sort(files);
  return files;
}

}  // namespace faceprobe::assets

#include "support/photos.h"

#include <algorithm>

namespace faceprobe::bench {

bool is_photo(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (path.stem().extension() == ".mask") return false;
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

std::vector<std::filesystem::path> photos_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> photos;
  if (!std::filesystem::is_directory(folder)) return photos;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_photo(entry.path())) photos.push_back(entry.path());
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

std::string without_folder(std::string text, const std::filesystem::path& folder, const std::string& name) {
  const std::string mention = folder.string();
  if (mention.empty()) return text;
  for (std::size_t at = text.find(mention); at != std::string::npos; at = text.find(mention, at + name.size())) {
    text.replace(at, mention.size(), name);
  }
  return text;
}

}  // namespace faceprobe::bench

#include "support/photos.h"

#include "faceprobe/core/error.h"

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

std::map<std::string, std::array<std::filesystem::path, 2>> london_pairs(const std::filesystem::path& london) {
  std::map<std::string, std::array<std::filesystem::path, 2>> people;
  std::size_t expression = 0;
  for (const char* folder : {"neutral_front", "smiling_front"}) {
    for (const std::filesystem::path& file : photos_below(london / folder))
      people[file.stem().string().substr(0, 3)][expression] = file;
    ++expression;
  }
  if (people.empty()) throw Error(ExitCode::kInput, "There are no people in " + london.string() + ".");
  return people;
}

}  // namespace faceprobe::bench

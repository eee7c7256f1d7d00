#pragma once
// Photos in a data folder.

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::bench {

// A .jpg, .jpeg or .png that is not a mask beside a photo (NAME.mask.png).
bool is_photo(const std::filesystem::path& path);
// Photos in the folder and below, sorted by path; empty when there is no such folder.
std::vector<std::filesystem::path> photos_below(const std::filesystem::path& folder);
// Of each London person (by number) the neutral and the smiling photo; a path is empty where there is none. Throws Error(kInput) when there
// is nobody.
std::map<std::string, std::array<std::filesystem::path, 2>> london_pairs(const std::filesystem::path& london);
// `text` with every mention of the folder replaced by `name`: results are published, where the data lies is nobody's business.
std::string without_folder(std::string text, const std::filesystem::path& folder, const std::string& name);

// Every n-th item, from the first on.
template <class T>
std::vector<T> every_nth(const std::vector<T>& items, int n) {
  std::vector<T> kept;
  for (std::size_t i = 0; i < items.size(); i += static_cast<std::size_t>(n)) kept.push_back(items[i]);
  return kept;
}

}  // namespace faceprobe::bench

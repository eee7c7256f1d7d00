#pragma once
// Internal: a folder's files of some kinds, in the order of their names, so that runs do not depend on the file system.

#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace faceprobe::assets {

// Extensions in lower case, with the dot. Throws Error(kInput) when the folder is not there.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            std::initializer_list<std::string_view> extensions);

}  // namespace faceprobe::assets

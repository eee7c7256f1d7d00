#include "faceprobe/io/data_files.h"

#include "faceprobe/core/error.h"

#include <cstdlib>
#include <system_error>

namespace faceprobe::io {

namespace fs = std::filesystem;

std::vector<fs::path> data_folders() {
  // A folder that the user names is the only one searched: a model missing in it must not be replaced silently by another.
  if (const char* named = std::getenv("FACEPROBE_DATA_DIR"); named != nullptr && *named != '\0')
    return {fs::path(named)};
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(executable.parent_path().parent_path() / "share" / "faceprobe");
  folders.emplace_back(FACEPROBE_BUILD_DATA_DIR);
  folders.emplace_back(FACEPROBE_BUILD_MODELS_DIR);
  return folders;
}

fs::path find_data(const std::string& name) {
  for (const fs::path& folder : data_folders()) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return folder / name;
  }
  return {};
}

fs::path data_file(const std::string& name) {
  std::string searched;
  for (const fs::path& folder : data_folders()) {
    fs::path candidate = folder / name;
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate;
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw Error(ExitCode::kModel, "The data file " + name + " is not in any of: " + searched +
                                    ". Run scripts/setup.sh, or set FACEPROBE_DATA_DIR to the folder that holds it.");
}

}  // namespace faceprobe::io

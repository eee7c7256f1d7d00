#include "cycles/run_blender.h"

#include "faceprobe/core/error.h"
#include "support/shell_word.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace faceprobe::bench {

bool run_blender(const std::string& blender, const std::filesystem::path& script, const std::filesystem::path& job,
                 const std::filesystem::path& log) {
  const std::string command = shell_word(blender) + " --background --factory-startup --python-exit-code 1 --python " +
                              shell_word(script.string()) + " -- " + shell_word(job.string()) + " > " +
                              shell_word(log.string()) + " 2>&1";
  return std::system(command.c_str()) == 0;
}

std::string blender_version(const std::string& blender) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((shell_word(blender) + " --version 2>/dev/null").c_str(), "r"),
                                                   pclose);
  std::array<char, 200> line{};
  if (!pipe || !std::fgets(line.data(), static_cast<int>(line.size()), pipe.get())) return {};
  const std::string text = line.data();
  return text.rfind("Blender ", 0) == 0 ? text.substr(8, text.find_first_of("\r\n") - 8) : std::string();
}

void require_blender(const std::string& blender) {
  if (blender_version(blender).empty()) {
    throw Error(ExitCode::kModel, "There is no Blender (" + blender +
                                      "); install Debian's package blender, or name the program with --blender.");
  }
}

}  // namespace faceprobe::bench

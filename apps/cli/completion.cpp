#include "completion.h"

#include "faceprobe/core/version.h"

namespace faceprobe::cli {

std::string shell_quoted(const std::string& text, bool fish) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += fish ? "\\'" : "'\\''";
    } else if (c == '\\' && fish) {
      out += "\\\\";
    } else {
      out += c;
    }
  }
  return out + "'";
}

std::string written_by(const std::string& shell) {
  return "# Completion of faceprobe " + std::string(kVersion) + ", written by `faceprobe completion " + shell + "`.\n";
}

}  // namespace faceprobe::cli

#pragma once
// A text as one word of a shell's command, whatever is in it.

#include <string>

namespace faceprobe::bench {

inline std::string shell_word(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace faceprobe::bench

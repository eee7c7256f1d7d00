#include "eval/csv_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace faceprobe::eval {

std::string exact(double value) {
  if (!std::isfinite(value)) return {};
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace faceprobe::eval

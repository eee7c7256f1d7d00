#include "eval/markdown.h"

#include <array>
#include <charconv>
#include <cmath>

namespace faceprobe::eval {

std::string rounded(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 512> text;  // the largest double has 309 digits
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  return end.ec == std::errc() ? std::string(text.data(), end.ptr) : std::to_string(value);
}

std::string counted(std::size_t count, std::size_t missing) {
  return missing == 0 ? std::to_string(count) : std::to_string(count) + " (" + std::to_string(missing) + " missing)";
}

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

std::string markdown_head(const std::vector<std::string>& titles) {
  std::string head = "|";
  std::string rule = "|";
  for (const std::string& title : titles) {
    head += ' ' + markdown_cell(title) + " |";
    rule += rule == "|" ? "---|" : "---:|";  // names to the left, numbers to the right
  }
  return head + '\n' + rule + '\n';
}

}  // namespace faceprobe::eval

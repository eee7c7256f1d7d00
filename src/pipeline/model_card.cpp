#include "pipeline/model_card.h"

#include "faceprobe/io/data_files.h"

#include <cstdint>
#include <sstream>
#include <string_view>

namespace faceprobe::pipeline {
namespace {

constexpr std::size_t kHashDigits = 64;
constexpr std::int64_t kMostCardBytes = 1 << 20;
constexpr std::int64_t kMostModelBytes = 1 << 30;

// The first `...` of 64 hex digits in a line.
std::string hash_in(std::string_view line) {
  for (std::size_t at = line.find('`'); at != std::string_view::npos; at = line.find('`', at + 1)) {
    const std::string_view word = line.substr(at + 1, kHashDigits);
    const bool hex = word.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    const std::size_t end = at + 1 + kHashDigits;
    if (word.size() == kHashDigits && hex && end < line.size() && line[end] == '`') return std::string(word);
  }
  return {};
}

}  // namespace

std::string hash_on_card(const std::string& card, const std::string& name) {
  std::istringstream lines(card);
  bool in_section = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) in_section = line == "## " + name;
    const bool own_row = line.starts_with("| `" + name + "` |");
    if (!own_row && !(in_section && line.starts_with("| sha256 |"))) continue;
    if (std::string hash = hash_in(line); !hash.empty()) return hash;
  }
  return {};
}

std::string card_mismatch(const std::filesystem::path& model) {
  const std::filesystem::path card = model.parent_path() / "README.md";
  if (!std::filesystem::is_regular_file(card)) return {};
  const std::string named = hash_on_card(io::read_text(card, kMostCardBytes), model.filename().string());
  if (named.empty()) return {};
  const std::string found = io::sha256_of_file(model, kMostModelBytes);
  if (found == named) return {};
  return model.string() + " has the sha256 " + found + ", and " + card.string() + " names " + named +
         ": the file was changed or is of another version. Install it again.";
}

}  // namespace faceprobe::pipeline

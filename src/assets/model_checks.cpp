#include "assets/model_checks.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <set>

namespace faceprobe::assets {
namespace {

constexpr int kMaxLine = 64 << 10;
constexpr std::int64_t kMaxLibraries = 64;  // mtllib lines; each is read again

// Counts an OBJ's lines by their first word, without keeping them.
class ObjCounter {
 public:
  explicit ObjCounter(const ModelFile& file) : file_(file) {}

  void read(char c) {
    if (c == '\0') file_.refuse("is not a Wavefront OBJ: it holds zero bytes, and an OBJ is text. Export it again.");
    if (c == '\n' && last_ != '\\') {
      end_line();
      return;
    }
    if (c == '\r') return;
    if (++length_ > kMaxLine) {
      file_.refuse("has a line of more than " + std::to_string(kMaxLine) +
                   " bytes, which no Wavefront OBJ needs. Export it again.");
    }
    const bool space = c == ' ' || c == '\t' || c == '\n' || c == '\\';
    if (!space && in_space_) ++words_;
    if (!space && words_ == 1 && keyword_.size() < 8) keyword_ += c;
    in_space_ = space;
    last_ = c;
  }

  void end_line() {
    const ModelLimits& limits = file_.limits;
    const int arguments = words_ - 1;
    if (keyword_ == "f" || keyword_ == "l" || keyword_ == "p") {
      if (arguments > kMaxCorners) file_.check_count(arguments, kMaxCorners, "corners in one face");
      triangles_ += std::max(arguments - 2, 1);
      file_.check_count(triangles_, limits.max_triangles, "triangles");
    } else if (keyword_ == "v" || keyword_ == "vn" || keyword_ == "vt") {
      auto& count = vertices_[keyword_ == "v" ? 0 : keyword_ == "vn" ? 1 : 2];
      file_.check_count(++count, limits.max_vertices, keyword_ == "v" ? "vertices" : "'" + keyword_ + "' lines");
    } else if (keyword_ == "o" || keyword_ == "g" || keyword_ == "usemtl") {
      file_.check_count(++parts_, limits.max_parts, "groups");
    } else if (keyword_ == "mtllib") {
      file_.check_count(++libraries_, kMaxLibraries, "'mtllib' lines");
    }
    keyword_.clear();
    words_ = length_ = 0;
    in_space_ = true;
    last_ = '\n';
  }

  bool any() const { return triangles_ > 0 || vertices_[0] > 0; }

 private:
  const ModelFile& file_;
  std::string keyword_;
  int words_ = 0, length_ = 0;
  bool in_space_ = true;
  char last_ = '\n';
  std::int64_t triangles_ = 0, parts_ = 0, libraries_ = 0;
  std::array<std::int64_t, 3> vertices_{};
};

std::int64_t count_of(std::string_view text, std::string_view word) {
  std::int64_t count = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

}  // namespace

std::string ModelLimits::validate() const {
  const auto check = [](const char* what, std::int64_t value) {
    return value >= 1 ? std::string()
                      : "The limit on " + std::string(what) + " must be at least 1, not " + std::to_string(value) + ".";
  };
  for (const std::string& problem :
       {check("a model's bytes", max_file_bytes), check("triangles", max_triangles), check("vertices", max_vertices),
        check("a model's parts", max_parts), check("texture pixels", max_texture_pixels), picture.validate()}) {
    if (!problem.empty()) return problem;
  }
  return {};
}

void ModelFile::check_count(std::int64_t found, std::int64_t allowed, const std::string& what) const {
  if (found <= allowed) return;
  refuse("has " + std::to_string(found) + " or more " + what + "; at most " + std::to_string(allowed) +
         " are allowed. Simplify it in the program that made it.");
}

void check_obj(const ModelFile& file) {
  std::ifstream stream(file.path, std::ios::binary);
  std::vector<char> block(1 << 20);
  ObjCounter counter(file);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    for (std::streamsize i = 0; i < stream.gcount(); ++i) counter.read(block[static_cast<std::size_t>(i)]);
  }
  if (stream.bad()) file.refuse("cannot be read.");
  counter.end_line();
  if (!counter.any()) file.refuse("is not a Wavefront OBJ: it has no 'v' and no 'f' lines. Name an OBJ file.");
}

std::vector<std::byte> clean_mtl(std::string_view text) {
  static const std::set<std::string_view> kKept = {"newmtl", "Kd", "Ks", "Ns", "d", "Tr", "Ni", "illum", "map_Kd"};
  std::string out;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    const std::size_t end = line.find_first_of(" \t");
    if (end == std::string_view::npos || !kKept.contains(line.substr(0, end))) continue;
    if (out.empty() && !line.starts_with("newmtl")) continue;
    out += line;
    out += '\n';
  }
  const auto* first = reinterpret_cast<const std::byte*>(out.data());
  return {first, first + out.size()};
}

void check_stl(const ModelFile& file, std::string_view bytes) {
  constexpr std::size_t kHeader = 84;
  if (bytes.size() >= kHeader) {
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);  // little-endian, as we are
    const std::uint64_t needed = kHeader + 50ULL * triangles;
    if (needed == bytes.size()) {
      file.check_count(triangles, file.limits.max_triangles, "triangles");
      return;
    }
  }
  if (!bytes.starts_with("solid") || bytes.find("facet") == std::string_view::npos ||
      bytes.find('\0') != std::string_view::npos) {
    file.refuse(
        "is not an STL, or is cut short: neither the text kind nor a whole number of binary triangles. Export it "
        "again.");
  }
  file.check_count(count_of(bytes, "endfacet"), file.limits.max_triangles, "triangles");
  file.check_count(count_of(bytes, "vertex"), 3LL * file.limits.max_triangles, "corners");
  file.check_count(count_of(bytes, "endsolid"), file.limits.max_parts, "solids");
}

}  // namespace faceprobe::assets

// PLY: header and body are walked through before assimp sees them, since it believes list lengths and indices.

#include "assets/model_checks.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>

namespace faceprobe::assets {
namespace {

constexpr std::size_t kMaxHeader = 64 << 10;

struct PlyType {
  std::string name;
  std::size_t size = 0;
  bool whole = true;
};

struct Property {
  std::string name;
  PlyType type;
  PlyType length;  // of a list; size 0 otherwise
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

PlyType type_named(const ModelFile& file, const std::string& name) {
  static const std::map<std::string, PlyType> kTypes = {{"char", {"char", 1}},
                                                        {"int8", {"char", 1}},
                                                        {"uchar", {"uchar", 1}},
                                                        {"uint8", {"uchar", 1}},
                                                        {"short", {"short", 2}},
                                                        {"int16", {"short", 2}},
                                                        {"ushort", {"ushort", 2}},
                                                        {"uint16", {"ushort", 2}},
                                                        {"int", {"int", 4}},
                                                        {"int32", {"int", 4}},
                                                        {"uint", {"uint", 4}},
                                                        {"uint32", {"uint", 4}},
                                                        {"float", {"float", 4, false}},
                                                        {"float32", {"float", 4, false}},
                                                        {"double", {"double", 8, false}},
                                                        {"float64", {"double", 8, false}}};
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) file.refuse("has the unknown type '" + name + "' in its PLY header. Export it again.");
  return found->second;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class PlyReader {
 public:
  PlyReader(const ModelFile& file, std::string_view bytes) : file_(file), rest_(bytes) {}

  std::vector<std::byte> run() {
    read_header();
    check_elements();
    const std::string_view body = rest_;
    for (const Element& element : elements_) {
      for (std::int64_t i = 0; i < element.count; ++i) walk(element);
    }
    std::string out = header_text();
    if (format_ != "ascii" && body.starts_with('\n')) out += '\n';  // assimp takes one for the end of the header's line
    out += body.substr(0, body.size() - rest_.size());
    const auto* first = reinterpret_cast<const std::byte*>(out.data());
    return {first, first + out.size()};
  }

 private:
  [[noreturn]] void cut_short() const {
    file_.refuse("is cut short: its PLY header announces more than the file holds. Copy or download it again.");
  }
  [[noreturn]] void malformed(const std::string& what) const {
    file_.refuse("is not a PLY that can be read: " + what + ". Export it again.");
  }

  std::string_view next_line() {
    if (rest_.empty()) cut_short();
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    return line;
  }

  void read_header() {
    const std::string_view head = rest_.substr(0, kMaxHeader);
    if (!head.starts_with("ply") || head.find("end_header") == std::string_view::npos)
      malformed("it has no PLY header");
    next_line();
    while (true) {
      const std::vector<std::string> words = words_of(next_line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format" && words.size() >= 2) {
        format_ = words[1];
      } else if (words[0] == "element" && words.size() == 3) {
        elements_.push_back({words[1], whole(words[2]), {}});
      } else if (words[0] == "property" && words.size() == 3 && !elements_.empty()) {
        elements_.back().properties.push_back({words[2], type_named(file_, words[1]), {}});
      } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !elements_.empty()) {
        const PlyType length = type_named(file_, words[2]);
        if (!length.whole) malformed("a list's length is no whole number");
        elements_.back().properties.push_back({words[4], type_named(file_, words[3]), length});
      } else {
        malformed("its header has the line '" + words[0] + " ...'");
      }
    }
    if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
      malformed("its format is '" + format_ + "'");
  }

  std::int64_t whole(std::string_view word) const {
    std::int64_t value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size())
      malformed(std::string("'").append(word.substr(0, 40)) + "' stands for a whole number");
    return value;
  }

  void check_elements() {
    std::vector<std::string> seen;
    for (const Element& element : elements_) {
      if (element.count < 0) malformed("a negative number of elements");
      if (element.name == "face")
        file_.check_count(element.count, file_.limits.max_triangles, "triangles");
      else
        file_.check_count(element.count, file_.limits.max_vertices,
                          element.name == "vertex" ? "vertices" : "'" + element.name + "' elements");
      if (element.name == "vertex") vertices_ = element.count;
      if (element.name == "tristrips") malformed("it holds triangle strips, and plain triangles are needed");
      if (std::ranges::find(seen, element.name) != seen.end()) malformed("it has two elements '" + element.name + "'");
      if (element.name == "face" && vertices_ == 0) malformed("faces without vertices before them");
      if (element.count > 0 && element.properties.empty()) malformed("'" + element.name + "' has no properties");
      if (element.properties.size() > 256) malformed("'" + element.name + "' has more than 256 properties");
      seen.push_back(element.name);
      int lists = 0;
      for (const Property& property : element.properties) {
        const bool list = property.length.size > 0;
        if (list && element.name == "vertex") malformed("its vertices hold lists");
        if (is_index(property) && (!list || !property.type.whole || ++lists > 1))
          malformed("its faces' indices are no list of whole numbers");
      }
      if (element.name == "face" && element.count > 0 && lists == 0) malformed("its faces have no list vertex_indices");
    }
  }

  static bool is_index(const Property& property) {
    return property.name == "vertex_indices" || property.name == "vertex_index";
  }

  void walk(const Element& element) {
    std::vector<std::string>& words = words_;
    word_ = 0;
    if (format_ == "ascii") words = words_of(next_line());
    std::int64_t corners = 0, texture_values = 0;
    for (const Property& property : element.properties) {
      const std::int64_t length = property.length.size > 0 ? static_cast<std::int64_t>(value(property.length)) : 1;
      if (length < 0) malformed("a list has a negative length");
      if (property.length.size > 0) file_.check_count(length, kMaxCorners, "corners in one face");
      const bool index = element.name == "face" && is_index(property);
      for (std::int64_t i = 0; i < length; ++i) {
        const double number = value(property.type);
        if (index && !(number >= 0 && number < static_cast<double>(vertices_))) {
          malformed("a face names vertex " + std::to_string(static_cast<std::int64_t>(number)) + ", and there are " +
                    std::to_string(vertices_) + ", counted from 0");
        }
      }
      if (index) corners = length;
      if (property.name == "texcoord") texture_values = length;
    }
    if (element.name != "face") return;
    if (texture_values > 2 * corners) malformed("a face has more texture points than corners");
    triangles_ += std::max<std::int64_t>(corners - 2, 1);
    file_.check_count(triangles_, file_.limits.max_triangles, "triangles");
  }

  // The next number of the body.
  double value(const PlyType& type) {
    if (format_ == "ascii") {
      if (word_ >= words_.size()) cut_short();
      const std::string& word = words_[word_++];
      if (type.whole) return static_cast<double>(whole(word));
      double number = 0;
      const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
      const auto [end, fault] = std::from_chars(first, word.data() + word.size(), number);
      if (fault == std::errc::invalid_argument || end != word.data() + word.size())
        malformed(std::string("'").append(word, 0, 40) + "' stands for a number");
      return number;
    }
    if (rest_.size() < type.size) cut_short();
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = format_ == "binary_big_endian" ? type.size - 1 - i : i;
      bits |= std::uint64_t{static_cast<unsigned char>(rest_[at])} << (8 * i);
    }
    rest_.remove_prefix(type.size);
    if (!type.whole) return 0;  // judged after assimp has read it
    const bool is_signed = !type.name.starts_with('u');
    const auto shift = static_cast<int>(64 - 8 * type.size);
    return is_signed ? static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift)
                     : static_cast<double>(bits);
  }

  std::string header_text() const {
    std::string text = "ply\nformat " + format_ + " 1.0\n";
    for (const Element& element : elements_) {
      text += "element " + element.name + " " + std::to_string(element.count) + "\n";
      for (const Property& property : element.properties) {
        text += "property " + (property.length.size > 0 ? "list " + property.length.name + " " : std::string()) +
                property.type.name + " " + property.name + "\n";
      }
    }
    return text + "end_header\n";
  }

  const ModelFile& file_;
  std::string_view rest_;
  std::string format_;
  std::vector<Element> elements_;
  std::vector<std::string> words_;
  std::size_t word_ = 0;
  std::int64_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

std::vector<std::byte> clean_ply(const ModelFile& file, std::string_view bytes) { return PlyReader(file, bytes).run(); }

}  // namespace faceprobe::assets

#include "assets/npy.h"

#include "faceprobe/io/data_files.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace faceprobe::assets {
namespace {

constexpr std::int64_t kMaxBytes = 1LL << 30;
constexpr std::size_t kMaxSides = 8;

// The file is "\x93NUMPY", two bytes of version, the header's length (2 bytes in version 1, 4 in version 2, little-endian), the
// header - a Python dictionary of 'descr', 'fortran_order' and 'shape' - and the values (numpy.lib.format).
struct Header {
  std::string_view text;
  std::size_t data_offset = 0;
};

Header find_header(std::span<const std::byte> bytes, const std::string& name) {
  const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(bytes[i]); };
  if (bytes.size() < 12 || std::memcmp(bytes.data(), "\x93NUMPY", 6) != 0)
    refuse_input(name + " is not a NumPy array file.");
  const std::size_t version = byte(6);
  if (version != 1 && version != 2) {
    refuse_input(name + " is a NumPy array file of version " + std::to_string(version) + "; versions 1 and 2 are read.");
  }
  const std::size_t start = version == 1 ? 10 : 12;
  const std::size_t length =
      version == 1 ? byte(8) + 256 * byte(9) : byte(8) + 256 * (byte(9) + 256 * (byte(10) + 256 * byte(11)));
  if (length > bytes.size() - start) refuse_input(name + " ends within its header: the file was cut off.");
  return {{reinterpret_cast<const char*>(bytes.data()) + start, length}, start + length};
}

// What follows "'key':" in the dictionary.
std::string_view entry(std::string_view header, const std::string& key, const std::string& name) {
  const std::size_t at = header.find(key);
  const std::size_t colon = at == std::string_view::npos ? at : header.find(':', at);
  const std::size_t value = colon == std::string_view::npos ? colon : header.find_first_not_of(' ', colon + 1);
  if (value == std::string_view::npos) refuse_input(name + " has no " + key + " in its header.");
  return header.substr(value);
}

std::vector<std::size_t> parse_shape(std::string_view text, const std::string& name) {
  const std::size_t close = text.find(')');
  if (text.front() != '(' || close == std::string_view::npos)
    refuse_input(name + " has a damaged shape in its header.");
  std::vector<std::size_t> shape;
  const char* at = text.data() + 1;
  const char* end = text.data() + close;
  while (true) {
    while (at < end && (*at == ' ' || *at == ',')) ++at;
    if (at == end) return shape;
    std::size_t side = 0;
    const auto [next, fault] = std::from_chars(at, end, side);
    if (fault != std::errc() || shape.size() == kMaxSides) refuse_input(name + " has a damaged shape in its header.");
    shape.push_back(side);
    at = next;
  }
}

std::size_t value_count(const std::vector<std::size_t>& shape, const std::string& name) {
  std::size_t count = 1;
  for (const std::size_t side : shape) {
    if (side != 0 && count > static_cast<std::size_t>(kMaxBytes) / side) refuse_input(name + " is larger than 1 GiB.");
    count *= side;
  }
  return count;
}

template <class T>
void convert(std::span<const std::byte> bytes, const std::string& name, Array& array) {
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    T value;
    std::memcpy(static_cast<void*>(&value), bytes.data() + i * sizeof(T), sizeof(T));
    if constexpr (std::is_integral_v<T>) {
      if (std::abs(static_cast<double>(value)) > kMaxInteger) {
        refuse_input(name + " holds the number " + std::to_string(value) + ", too large for an index.");
      }
    }
    array.values[i] = static_cast<float>(value);
  }
}

struct Kind {
  std::string_view descr;  // with its quotes
  std::size_t size;
  bool is_integer;
  void (*convert)(std::span<const std::byte>, const std::string&, Array&);
};
constexpr Kind kKinds[] = {{"'<f2'", 2, false, convert<Eigen::half>}, {"'<f4'", 4, false, convert<float>},
                           {"'<f8'", 8, false, convert<double>},      {"'|u1'", 1, true, convert<std::uint8_t>},
                           {"'<i4'", 4, true, convert<std::int32_t>}, {"'<i8'", 8, true, convert<std::int64_t>}};

}  // namespace

Array parse_npy(std::span<const std::byte> bytes, const std::string& name) {
  const Header header = find_header(bytes, name);
  const std::string_view descr = entry(header.text, "'descr'", name);
  const Kind* kind = nullptr;
  for (const Kind& known : kKinds) {
    if (descr.starts_with(known.descr)) kind = &known;
  }
  if (kind == nullptr) {
    const std::string found(descr.substr(0, descr.find_first_of(",}")));
    refuse_input(name + " holds values of type " + found + "; little-endian f2, f4, f8, u1, i4 and i8 are read.");
  }
  if (!entry(header.text, "'fortran_order'", name).starts_with("False")) {
    refuse_input(name + " is stored by columns (fortran_order); save it again through numpy.ascontiguousarray.");
  }
  Array array{parse_shape(entry(header.text, "'shape'", name), name), kind->is_integer, {}};
  const std::size_t count = value_count(array.shape, name);
  const std::size_t found = bytes.size() - header.data_offset;
  if (found != count * kind->size) {
    refuse_input(name + " should hold " + std::to_string(count * kind->size) + " bytes of values (" +
                 shape_text(array.shape) + ") and holds " + std::to_string(found) +
                 ": the file was cut off or changed.");
  }
  array.values.resize(count);
  kind->convert(bytes.subspan(header.data_offset), name, array);
  return array;
}

Array read_npy(const std::filesystem::path& path) { return parse_npy(io::read_file(path, kMaxBytes), quoted(path)); }

}  // namespace faceprobe::assets

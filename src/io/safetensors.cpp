#include "faceprobe/io/safetensors.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "io/byte_reader.h"
#include "io/safetensors_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

namespace faceprobe::io {
namespace {

using nlohmann::json;

constexpr int kMaxRank = 8;
constexpr int kMaxDepth = 3;  // header > tensor > shape

struct Problem {
  std::string what;
};

enum class Dtype { kF16, kBf16, kF32 };

struct Entry {
  std::string name;
  Dtype dtype;
  std::vector<std::int64_t> shape;
  std::uint64_t count;
  std::uint64_t begin, end;
};

// A name from the file, fit for a terminal.
std::string quoted(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kLongest ? "...'" : "'");
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string text = "[";
  for (const std::int64_t side : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(side);
  return text + "]";
}

// JSON with two refinements: nothing nested deeper than a header needs, and no key twice (of which a parser would silently
// keep one).
json parse_header(std::string_view text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMaxDepth) throw Problem{"has a header nested too deeply"};
    if (event == json::parse_event_t::object_start) {
      keys.emplace_back();
    } else if (event == json::parse_event_t::object_end) {
      keys.pop_back();
    } else if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      throw Problem{"names " + quoted(parsed.get<std::string>()) + " twice"};
    }
    return true;
  };
  try {
    json header = json::parse(text.begin(), text.end(), watch);
    if (!header.is_object()) throw Problem{"has a header that is no JSON object"};
    return header;
  } catch (const json::exception&) {
    throw Problem{"has a header that is not valid JSON"};
  }
}

std::uint64_t unsigned_number(const json& value, const std::string& name) {
  if (!value.is_number_unsigned())
    throw Problem{"has a size or offset that is no whole number in tensor " + quoted(name)};
  return value.get<std::uint64_t>();
}

Dtype dtype_of(const json& description, const std::string& name) {
  const auto found = description.find("dtype");
  if (found == description.end() || !found->is_string()) throw Problem{"has no dtype for tensor " + quoted(name)};
  const auto& text = found->get_ref<const std::string&>();
  if (text == "F16") return Dtype::kF16;
  if (text == "BF16") return Dtype::kBf16;
  if (text == "F32") return Dtype::kF32;
  throw Problem{"has tensor " + quoted(name) + " of dtype " + quoted(text) + "; F16, BF16 and F32 are read"};
}

Entry read_entry(const std::string& name, const json& description, std::uint64_t data_size) {
  if (!description.is_object()) throw Problem{"describes tensor " + quoted(name) + " by something that is no object"};
  Entry entry{.name = name, .dtype = dtype_of(description, name), .shape = {}, .count = 1, .begin = 0, .end = 0};
  const auto shape = description.find("shape");
  const auto offsets = description.find("data_offsets");
  if (shape == description.end() || !shape->is_array() || shape->size() > kMaxRank) {
    throw Problem{"has no shape of at most 8 sides for tensor " + quoted(name)};
  }
  if (offsets == description.end() || !offsets->is_array() || offsets->size() != 2) {
    throw Problem{"has no pair of offsets for tensor " + quoted(name)};
  }
  for (const json& side : *shape) {
    const std::uint64_t length = unsigned_number(side, name);
    if (length > (1ULL << 40) || __builtin_mul_overflow(entry.count, length, &entry.count)) {
      throw Problem{"has a shape that is too large for tensor " + quoted(name)};
    }
    entry.shape.push_back(static_cast<std::int64_t>(length));
  }
  entry.begin = unsigned_number((*offsets)[0], name);
  entry.end = unsigned_number((*offsets)[1], name);
  if (entry.begin > entry.end || entry.end > data_size) {
    throw Problem{"has tensor " + quoted(name) + " outside the file: it is cut short or damaged"};
  }
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(entry.count, entry.dtype == Dtype::kF32 ? 4ULL : 2ULL, &bytes) ||
      bytes != entry.end - entry.begin) {
    throw Problem{"has tensor " + quoted(name) + " of shape " + shape_text(entry.shape) + " with " +
                  std::to_string(entry.end - entry.begin) + " bytes, which do not fit one another"};
  }
  return entry;
}

float from_bits(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// IEEE 754 binary16.
float from_half(std::uint32_t half) {
  const std::uint32_t sign = (half & 0x8000U) << 16;
  const std::uint32_t exponent = (half >> 10) & 31U;
  const std::uint32_t fraction = half & 0x3FFU;
  if (exponent == 31) return from_bits(sign | 0x7F800000U | (fraction << 13));
  if (exponent == 0) return (sign != 0 ? -1.0F : 1.0F) * static_cast<float>(fraction) * 0x1p-24F;
  return from_bits(sign | ((exponent + 112U) << 23) | (fraction << 13));
}

std::vector<float> read_values(const Entry& entry, std::span<const std::byte> data) {
  std::vector<float> values(entry.count);
  const std::byte* from = data.data() + entry.begin;
  const std::size_t width = entry.dtype == Dtype::kF32 ? 4 : 2;
  for (float& value : values) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < width; ++i) bits |= std::to_integer<std::uint32_t>(from[i]) << (8 * i);
    from += width;
    value = entry.dtype == Dtype::kF32    ? from_bits(bits)
            : entry.dtype == Dtype::kBf16 ? from_bits(bits << 16)
                                          : from_half(bits);
    if (!std::isfinite(value)) throw Problem{"holds NaN or infinity in tensor " + quoted(entry.name)};
  }
  return values;
}

// In the order of their offsets the tensors must follow one another from the first byte of data to the last.
void require_full_cover(std::vector<Entry>& entries, std::uint64_t data_size) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.begin != b.begin ? a.begin < b.begin : a.end < b.end; });
  std::uint64_t reached = 0;
  for (const Entry& entry : entries) {
    if (entry.begin < reached) throw Problem{"has tensor " + quoted(entry.name) + " overlapping another"};
    if (entry.begin > reached) throw Problem{"has a hole before tensor " + quoted(entry.name)};
    reached = entry.end;
  }
  if (reached != data_size) {
    throw Problem{"has " + std::to_string(data_size - reached) + " bytes that belong to no tensor"};
  }
}

void read_metadata(const json& metadata, TensorFile& file) {
  if (!metadata.is_object()) throw Problem{"has __metadata__ that is no object"};
  for (const auto& [key, value] : metadata.items()) {
    if (!value.is_string()) throw Problem{"has a __metadata__ value that is no text: " + quoted(key)};
    file.metadata[key] = value.get<std::string>();
  }
}

TensorFile parse(std::span<const std::byte> bytes, const TensorFileLimits& limits) {
  constexpr std::uint64_t kPrefix = 8;
  if (bytes.size() < kPrefix) throw Problem{"has " + std::to_string(bytes.size()) + " bytes: it is cut short"};
  const ByteReader r(bytes, ByteOrder::kLittle);
  const std::uint64_t header_size = r.u64(0);
  if (header_size > static_cast<std::uint64_t>(limits.max_header_bytes)) {
    throw Problem{"claims a header of " + std::to_string(header_size) + " bytes, at most " +
                  std::to_string(limits.max_header_bytes) + " are allowed"};
  }
  if (!r.has(kPrefix, header_size)) throw Problem{"ends inside its header: it is cut short"};
  const json header =
      parse_header({reinterpret_cast<const char*>(bytes.data()) + kPrefix, static_cast<std::size_t>(header_size)});
  const std::span<const std::byte> data = bytes.subspan(kPrefix + header_size);
  if (header.size() > static_cast<std::uint64_t>(limits.max_tensors) + 1) {
    throw Problem{"has " + std::to_string(header.size()) + " tensors, at most " + std::to_string(limits.max_tensors) +
                  " are allowed"};
  }
  TensorFile file;
  std::vector<Entry> entries;
  for (const auto& [name, description] : header.items()) {
    if (name == "__metadata__") {
      read_metadata(description, file);
    } else {
      entries.push_back(read_entry(name, description, data.size()));
    }
  }
  require_full_cover(entries, data.size());
  for (const Entry& entry : entries) file.tensors[entry.name] = Tensor{entry.shape, read_values(entry, data)};
  return file;
}

}  // namespace

const Tensor& TensorFile::tensor(const std::string& name, const std::vector<std::int64_t>& shape) const {
  const auto found = tensors.find(name);
  if (found == tensors.end()) {
    throw Error(ExitCode::kModel, "The weights lack tensor " + quoted(name) + " of shape " + shape_text(shape) +
                                      ". They belong to another network or version.");
  }
  if (found->second.shape != shape) {
    throw Error(ExitCode::kModel, "The weights have tensor " + quoted(name) + " of shape " +
                                      shape_text(found->second.shape) + " where " + shape_text(shape) +
                                      " is wanted. They belong to another network or version.");
  }
  return found->second;
}

TensorFile safetensors_from_bytes(std::span<const std::byte> bytes, const std::string& name,
                                  const TensorFileLimits& limits) {
  try {
    TensorFile file = parse(bytes, limits);
    file.sha256 = sha256_hex(bytes.data(), bytes.size());
    return file;
  } catch (const Problem& problem) {
    throw Error(ExitCode::kModel, name + " is not a usable .safetensors file: it " + problem.what + ". Fetch it again.");
  }
}

TensorFile read_safetensors(const std::filesystem::path& path, const TensorFileLimits& limits) {
  std::vector<std::byte> bytes;
  try {
    bytes = read_file(path, limits.max_file_bytes);
  } catch (const Error& error) {
    throw Error(ExitCode::kModel, error.what());  // same sentence; a missing model is not a bad photo
  }
  return safetensors_from_bytes(bytes, path.string(), limits);
}

}  // namespace faceprobe::io

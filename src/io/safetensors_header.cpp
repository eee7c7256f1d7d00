#include "io/safetensors_header.h"

#include "io/byte_reader.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace faceprobe::io {

std::size_t size_of(Dtype dtype) {
  switch (dtype) {
    case Dtype::kU8: return 1;
    case Dtype::kF16:
    case Dtype::kBf16: return 2;
    case Dtype::kI32:
    case Dtype::kF32: return 4;
    case Dtype::kI64: return 8;
  }
  return 1;
}

std::string name_of(Dtype dtype) {
  switch (dtype) {
    case Dtype::kU8: return "U8";
    case Dtype::kI32: return "I32";
    case Dtype::kI64: return "I64";
    case Dtype::kF16: return "F16";
    case Dtype::kBf16: return "BF16";
    case Dtype::kF32: return "F32";
  }
  return "U8";
}

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

namespace {

using nlohmann::json;

constexpr int kMaxRank = 8;
constexpr int kMaxDepth = 3;  // header > tensor > shape

// JSON with two refinements: nothing nested deeper than a header needs, and no key twice (of which a parser would silently
// keep one).
json parse_header(std::string_view text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMaxDepth) throw TensorProblem{"has a header nested too deeply"};
    if (event == json::parse_event_t::object_start) {
      keys.emplace_back();
    } else if (event == json::parse_event_t::object_end) {
      keys.pop_back();
    } else if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      throw TensorProblem{"names " + quoted(parsed.get<std::string>()) + " twice"};
    }
    return true;
  };
  try {
    json header = json::parse(text.begin(), text.end(), watch);
    if (!header.is_object()) throw TensorProblem{"has a header that is no JSON object"};
    return header;
  } catch (const json::exception&) {
    throw TensorProblem{"has a header that is not valid JSON"};
  }
}

std::uint64_t unsigned_number(const json& value, const std::string& name) {
  if (!value.is_number_unsigned())
    throw TensorProblem{"has a size or offset that is no whole number in tensor " + quoted(name)};
  return value.get<std::uint64_t>();
}

Dtype dtype_of(const json& description, const std::string& name) {
  const auto found = description.find("dtype");
  if (found == description.end() || !found->is_string()) throw TensorProblem{"has no dtype for tensor " + quoted(name)};
  const auto& text = found->get_ref<const std::string&>();
  for (const Dtype dtype : {Dtype::kU8, Dtype::kI32, Dtype::kI64, Dtype::kF16, Dtype::kBf16, Dtype::kF32}) {
    if (text == name_of(dtype)) return dtype;
  }
  throw TensorProblem{"has tensor " + quoted(name) + " of dtype " + quoted(text) +
                      "; U8, I32, I64, F16, BF16 and F32 are read"};
}

TensorEntry read_entry(const std::string& name, const json& description, std::uint64_t data_size) {
  if (!description.is_object())
    throw TensorProblem{"describes tensor " + quoted(name) + " by something that is no object"};
  TensorEntry entry{.name = name, .dtype = dtype_of(description, name), .shape = {}, .count = 1, .begin = 0, .end = 0};
  const auto shape = description.find("shape");
  const auto offsets = description.find("data_offsets");
  if (shape == description.end() || !shape->is_array() || shape->size() > kMaxRank) {
    throw TensorProblem{"has no shape of at most 8 sides for tensor " + quoted(name)};
  }
  if (offsets == description.end() || !offsets->is_array() || offsets->size() != 2) {
    throw TensorProblem{"has no pair of offsets for tensor " + quoted(name)};
  }
  for (const json& side : *shape) {
    const std::uint64_t length = unsigned_number(side, name);
    if (length > (1ULL << 40) || __builtin_mul_overflow(entry.count, length, &entry.count)) {
      throw TensorProblem{"has a shape that is too large for tensor " + quoted(name)};
    }
    entry.shape.push_back(static_cast<std::int64_t>(length));
  }
  entry.begin = unsigned_number((*offsets)[0], name);
  entry.end = unsigned_number((*offsets)[1], name);
  if (entry.begin > entry.end || entry.end > data_size) {
    throw TensorProblem{"has tensor " + quoted(name) + " outside the file: it is cut short or damaged"};
  }
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(entry.count, static_cast<std::uint64_t>(size_of(entry.dtype)), &bytes) ||
      bytes != entry.end - entry.begin) {
    throw TensorProblem{"has tensor " + quoted(name) + " of shape " + shape_text(entry.shape) + " with " +
                        std::to_string(entry.end - entry.begin) + " bytes, which do not fit one another"};
  }
  return entry;
}

// In the order of their offsets the tensors must follow one another from the first byte of data to the last.
void require_full_cover(std::vector<TensorEntry>& entries, std::uint64_t data_size) {
  std::sort(entries.begin(), entries.end(), [](const TensorEntry& a, const TensorEntry& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  std::uint64_t reached = 0;
  for (const TensorEntry& entry : entries) {
    if (entry.begin < reached) throw TensorProblem{"has tensor " + quoted(entry.name) + " overlapping another"};
    if (entry.begin > reached) throw TensorProblem{"has a hole before tensor " + quoted(entry.name)};
    reached = entry.end;
  }
  if (reached != data_size) {
    throw TensorProblem{"has " + std::to_string(data_size - reached) + " bytes that belong to no tensor"};
  }
}

void read_metadata(const json& metadata, TensorHeader& file) {
  if (!metadata.is_object()) throw TensorProblem{"has __metadata__ that is no object"};
  for (const auto& [key, value] : metadata.items()) {
    if (!value.is_string()) throw TensorProblem{"has a __metadata__ value that is no text: " + quoted(key)};
    file.metadata[key] = value.get<std::string>();
  }
}

}  // namespace

TensorHeader parse_tensor_header(std::span<const std::byte> bytes, std::int64_t max_header_bytes,
                                 std::int64_t max_tensors) {
  constexpr std::uint64_t kPrefix = 8;
  if (bytes.size() < kPrefix) throw TensorProblem{"has " + std::to_string(bytes.size()) + " bytes: it is cut short"};
  const ByteReader r(bytes, ByteOrder::kLittle);
  const std::uint64_t header_size = r.u64(0);
  if (header_size > static_cast<std::uint64_t>(max_header_bytes)) {
    throw TensorProblem{"claims a header of " + std::to_string(header_size) + " bytes, at most " +
                        std::to_string(max_header_bytes) + " are allowed"};
  }
  if (!r.has(kPrefix, header_size)) throw TensorProblem{"ends inside its header: it is cut short"};
  const json header =
      parse_header({reinterpret_cast<const char*>(bytes.data()) + kPrefix, static_cast<std::size_t>(header_size)});
  if (header.size() > static_cast<std::uint64_t>(max_tensors) + 1) {
    throw TensorProblem{"has " + std::to_string(header.size()) + " tensors, at most " + std::to_string(max_tensors) +
                        " are allowed"};
  }
  TensorHeader result;
  result.data_begin = kPrefix + header_size;
  const std::uint64_t data_size = bytes.size() - result.data_begin;
  for (const auto& [name, description] : header.items()) {
    if (name == "__metadata__") {
      read_metadata(description, result);
    } else {
      result.entries.push_back(read_entry(name, description, data_size));
    }
  }
  require_full_cover(result.entries, data_size);
  return result;
}

}  // namespace faceprobe::io

#pragma once
// The header of a .safetensors file: names, types, shapes and places of its tensors, every one checked against the file.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::io {

// What is wrong with the file, as the rest of a sentence that begins with its name.
struct TensorProblem {
  std::string what;
};

enum class Dtype { kU8, kI32, kI64, kF16, kBf16, kF32 };
std::size_t size_of(Dtype dtype);
std::string name_of(Dtype dtype);  // as in the file: "U8", ...

struct TensorEntry {
  std::string name;
  Dtype dtype;
  std::vector<std::int64_t> shape;
  std::uint64_t count;
  std::uint64_t begin, end;  // bytes from the start of the data
};

struct TensorHeader {
  std::vector<TensorEntry> entries;  // in the order of their data, which they cover without hole or overlap
  std::map<std::string, std::string> metadata;
  std::uint64_t data_begin = 0;  // bytes from the start of the file
};

// Throws TensorProblem.
TensorHeader parse_tensor_header(std::span<const std::byte> bytes, std::int64_t max_header_bytes,
                                 std::int64_t max_tensors);

// A name from the file, fit for a terminal, and a shape for people.
std::string quoted(const std::string& text);
std::string shape_text(const std::vector<std::int64_t>& shape);

}  // namespace faceprobe::io

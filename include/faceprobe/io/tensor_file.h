#pragma once
// Named arrays in one .safetensors file, for data sets: written whole or not at all, read by mapping the file into memory, so that a
// sample of a large set costs no more than its own bytes. For network weights, which are small and are converted, see safetensors.h.
//
//   TensorFileBuilder builder;
//   std::span<float> depth = builder.add<float>("depth", {4, 128, 128});   // fill it, then
//   builder.write("shard.safetensors");
//
//   const MappedTensors file("shard.safetensors");
//   std::span<const float> all = file.values<float>("depth", {4, 128, 128});

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace faceprobe::io {

using Half = Eigen::half;  // IEEE 754 binary16

// The format's name of a C++ type: "U8", "I32", "I64", "F16" or "F32".
template <class T>
constexpr const char* tensor_type() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return "U8";
  if constexpr (std::is_same_v<T, std::int32_t>) return "I32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "I64";
  if constexpr (std::is_same_v<T, Half>) return "F16";
  if constexpr (std::is_same_v<T, float>) return "F32";
}

// Collects the arrays in memory: a file is at most as large as that allows.
class TensorFileBuilder {
 public:
  // Zeros, to be filled by the caller. The span stays valid as long as the builder. Throws std::invalid_argument for a name that is
  // there already or a negative length.
  template <class T>
  std::span<T> add(const std::string& name, const std::vector<std::int64_t>& shape) {
    const std::span<std::byte> bytes = add_bytes(name, tensor_type<T>(), sizeof(T), shape);
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
  void set_metadata(const std::string& key, const std::string& value) { metadata_[key] = value; }

  // Throws Error(kOutput); the old file, if any, is untouched then.
  void write(const std::filesystem::path& path) const;

 private:
  struct Array {
    std::string name, type;
    std::vector<std::int64_t> shape;
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
  };
  std::span<std::byte> add_bytes(const std::string& name, const char* type, std::size_t element,
                                 const std::vector<std::int64_t>& shape);

  std::vector<Array> arrays_;
  std::map<std::string, std::string> metadata_;
};

// A file mapped read-only. Copies share the map.
class MappedTensors {
 public:
  // Throws Error(kInput): not there, damaged, cut short.
  explicit MappedTensors(const std::filesystem::path& path);

  bool has(const std::string& name) const;  // whether there is an array of that name
  // Throws Error(kInput) when the array is not there.
  const std::vector<std::int64_t>& shape(const std::string& name) const;
  const std::map<std::string, std::string>& metadata() const { return metadata_; }

  // All values; throws Error(kInput) when the array is not there or of another type or shape. A length of -1 fits any.
  template <class T>
  std::span<const T> values(const std::string& name, const std::vector<std::int64_t>& shape) const {
    const std::span<const std::byte> bytes = bytes_of(name, tensor_type<T>(), shape);
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

 private:
  struct Array {
    std::string type;
    std::vector<std::int64_t> shape;
    std::span<const std::byte> bytes;
  };
  std::span<const std::byte> bytes_of(const std::string& name, const char* type,
                                      const std::vector<std::int64_t>& shape) const;
  const Array& array(const std::string& name) const;

  std::string path_;
  std::shared_ptr<const std::byte> map_;
  std::map<std::string, Array> arrays_;
  std::map<std::string, std::string> metadata_;
};

// Rounded to the nearest half, ties to even; beyond its range the largest finite one. `to` is as long as `from`, here and below.
void to_half(std::span<const float> from, std::span<Half> to);
void to_float(std::span<const Half> from, std::span<float> to);

}  // namespace faceprobe::io

#include "faceprobe/io/tensor_file.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "io/safetensors_header.h"

#include <fcntl.h>
#ifdef __F16C__
#include <immintrin.h>
#endif
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace faceprobe::io {
namespace {

constexpr std::size_t kAlignment =
    64;  // of the data's start: the header is padded, so that mapped arrays can be used in place
constexpr std::int64_t kMaxHeaderBytes = 1 << 20;
constexpr std::int64_t kMaxTensors = 4096;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ExitCode::kInput, path + " is not a data file that can be used: it " + what + ". Make it again.");
}

std::shared_ptr<const std::byte> map_file(const std::filesystem::path& path, std::size_t& size) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe would wait for who writes
  struct stat status {};
  if (fd < 0 || ::fstat(fd, &status) != 0) {
    const std::string reason = std::generic_category().message(errno);
    if (fd >= 0) ::close(fd);
    throw Error(ExitCode::kInput, path.string() + " cannot be read: " + reason + ".");
  }
  if (!S_ISREG(status.st_mode)) {
    ::close(fd);
    refuse(path.string(), "is no regular file");
  }
  size = static_cast<std::size_t>(status.st_size);
  void* map = size > 0 ? ::mmap(nullptr, size, PROT_READ, MAP_SHARED, fd, 0) : MAP_FAILED;
  ::close(fd);
  if (map == MAP_FAILED) refuse(path.string(), size == 0 ? "is empty" : "cannot be mapped into memory");
  return {static_cast<const std::byte*>(map), [size](const std::byte* p) { ::munmap(const_cast<std::byte*>(p), size); }};
}

}  // namespace

std::span<std::byte> TensorFileBuilder::add_bytes(const std::string& name, const char* type, std::size_t element,
                                                  const std::vector<std::int64_t>& shape) {
  std::size_t size = element;
  for (const std::int64_t length : shape) {
    if (length < 0) throw std::invalid_argument("tensor " + name + " has a negative length");
    size *= static_cast<std::size_t>(length);
  }
  if (std::ranges::any_of(arrays_, [&](const Array& array) { return array.name == name; })) {
    throw std::invalid_argument("tensor " + name + " is there twice");
  }
  arrays_.push_back({name, type, shape, std::make_unique<std::byte[]>(size), size});
  return {arrays_.back().bytes.get(), size};
}

void TensorFileBuilder::write(const std::filesystem::path& path) const {
  // Widest elements first: every array is then aligned to its own element.
  std::vector<const Array*> order;
  for (const Array& array : arrays_) order.push_back(&array);
  const auto rank = [](const Array* array) {
    return array->type == "I64" ? 0 : array->type.ends_with("32") ? 1 : array->type == "F16" ? 2 : 3;
  };
  std::ranges::stable_sort(order, {}, rank);
  nlohmann::ordered_json header;
  if (!metadata_.empty()) header["__metadata__"] = metadata_;
  std::size_t at = 0;
  for (const Array* array : order) {
    header[array->name] = {{"dtype", array->type}, {"shape", array->shape}, {"data_offsets", {at, at + array->size}}};
    at += array->size;
  }
  std::string text = header.dump();
  while ((8 + text.size()) % kAlignment != 0) text += ' ';
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    std::uint64_t length = text.size();
    std::array<char, 8> prefix{};
    for (char& byte : prefix) {
      byte = static_cast<char>(length & 0xFFU);
      length >>= 8U;
    }
    out.write(prefix.data(), prefix.size());
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    for (const Array* array : order) {
      out.write(reinterpret_cast<const char*>(array->bytes.get()), static_cast<std::streamsize>(array->size));
    }
    out.close();
    if (!out) {
      throw Error(ExitCode::kOutput,
                  path.string() + " cannot be written: " + std::generic_category().message(errno) + ".");
    }
  });
}

MappedTensors::MappedTensors(const std::filesystem::path& path) : path_(path.string()) {
  std::size_t size = 0;
  map_ = map_file(path, size);
  try {
    const std::span<const std::byte> file(map_.get(), size);
    TensorHeader header = parse_tensor_header(file, kMaxHeaderBytes, kMaxTensors);
    metadata_ = std::move(header.metadata);
    for (const TensorEntry& entry : header.entries) {
      if ((header.data_begin + entry.begin) % size_of(entry.dtype) != 0) {
        throw TensorProblem{"has tensor " + quoted(entry.name) + " at an odd place"};
      }
      arrays_[entry.name] = {name_of(entry.dtype), entry.shape,
                             file.subspan(header.data_begin + entry.begin, entry.end - entry.begin)};
    }
  } catch (const TensorProblem& problem) {
    refuse(path_, problem.what);
  }
}

const MappedTensors::Array& MappedTensors::array(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) refuse(path_, "lacks tensor " + quoted(name));
  return found->second;
}

bool MappedTensors::has(const std::string& name) const { return arrays_.contains(name); }

const std::vector<std::int64_t>& MappedTensors::shape(const std::string& name) const { return array(name).shape; }

std::span<const std::byte> MappedTensors::bytes_of(const std::string& name, const char* type,
                                                   const std::vector<std::int64_t>& shape) const {
  const Array& found = array(name);
  if (found.type != type)
    refuse(path_, "has tensor " + quoted(name) + " of dtype " + found.type + " where " + type + " is wanted");
  const bool fits = std::ranges::equal(
      found.shape, shape, [](std::int64_t is, std::int64_t wanted) { return wanted == -1 || is == wanted; });
  if (!fits) {
    refuse(path_, "has tensor " + quoted(name) + " of shape " + shape_text(found.shape) + " where " +
                      shape_text(shape) + " is wanted");
  }
  return found.bytes;
}

void to_half(std::span<const float> from, std::span<Half> to) {
  constexpr float kLargest = 65504.0F;
  std::size_t i = 0;
#ifdef __F16C__
  const __m256 largest = _mm256_set1_ps(kLargest);
  const __m256 least = _mm256_set1_ps(-kLargest);
  for (; i + 8 <= from.size(); i += 8) {
    const __m256 inside = _mm256_min_ps(largest, _mm256_max_ps(least, _mm256_loadu_ps(from.data() + i)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to.data() + i),
                     _mm256_cvtps_ph(inside, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
  }
#endif
  for (; i < from.size(); ++i) to[i] = Half(std::clamp(from[i], -kLargest, kLargest));
}

void to_float(std::span<const Half> from, std::span<float> to) {
  std::size_t i = 0;
#ifdef __F16C__
  for (; i + 8 <= from.size(); i += 8) {
    _mm256_storeu_ps(to.data() + i, _mm256_cvtph_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from.data() + i))));
  }
#endif
  for (; i < from.size(); ++i) to[i] = static_cast<float>(from[i]);
}

}  // namespace faceprobe::io

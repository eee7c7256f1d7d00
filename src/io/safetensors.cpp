#include "faceprobe/io/safetensors.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "io/safetensors_bytes.h"
#include "io/safetensors_header.h"

#include <cmath>
#include <cstring>

namespace faceprobe::io {
namespace {

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

std::vector<float> read_values(const TensorEntry& entry, std::span<const std::byte> data) {
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
    if (!std::isfinite(value)) throw TensorProblem{"holds NaN or infinity in tensor " + quoted(entry.name)};
  }
  return values;
}

TensorFile parse(std::span<const std::byte> bytes, const TensorFileLimits& limits) {
  TensorHeader header = parse_tensor_header(bytes, limits.max_header_bytes, limits.max_tensors);
  const std::span<const std::byte> data = bytes.subspan(header.data_begin);
  TensorFile file;
  file.metadata = std::move(header.metadata);
  for (const TensorEntry& entry : header.entries) {
    if (entry.dtype != Dtype::kF16 && entry.dtype != Dtype::kBf16 && entry.dtype != Dtype::kF32) {
      throw TensorProblem{"has tensor " + quoted(entry.name) + " of dtype '" + name_of(entry.dtype) +
                          "'; F16, BF16 and F32 are read"};
    }
    file.tensors[entry.name] = Tensor{entry.shape, read_values(entry, data)};
  }
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
  } catch (const TensorProblem& problem) {
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

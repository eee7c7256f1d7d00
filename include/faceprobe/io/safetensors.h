#pragma once
// Reads network weights from a .safetensors file (8-byte little-endian header length, JSON header, raw tensors). No code runs
// from the file; every offset, shape and size is checked before a byte of it is used, and the tensors must cover the data
// exactly, without holes or overlaps.
//
//   const TensorFile file = read_safetensors("models/face.safetensors");
//   const Tensor& w = file.tensor("enc1.weight", {32, 3, 3, 3});   // throws when missing or of another shape

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::io {

struct Tensor {
  std::vector<std::int64_t> shape;  // as the file has it; empty for one number
  std::vector<float> values;        // row-major; F16, BF16 and F32 in the file all become float
};

struct TensorFile {
  std::map<std::string, Tensor> tensors;
  std::map<std::string, std::string> metadata;  // the header's __metadata__
  std::string sha256;                           // of the whole file, hex

  // Throws Error(kModel) that names the tensor, the shape wanted and the shape found.
  const Tensor& tensor(const std::string& name, const std::vector<std::int64_t>& shape) const;
};

struct TensorFileLimits {
  std::int64_t max_file_bytes = 1LL << 30;  // 1 GiB
  std::int64_t max_header_bytes = 1LL << 20;
  std::int64_t max_tensors = 4096;
};

// Throws Error(kModel): not a safetensors file, damaged, over a limit, or holding NaN or infinity.
TensorFile read_safetensors(const std::filesystem::path& path, const TensorFileLimits& limits = {});

}  // namespace faceprobe::io

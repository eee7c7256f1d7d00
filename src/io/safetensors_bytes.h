#pragma once
// The parser behind read_safetensors, on bytes in memory; the fuzzer calls it too.

#include "faceprobe/io/safetensors.h"

#include <cstddef>
#include <span>
#include <string>

namespace faceprobe::io {

TensorFile safetensors_from_bytes(std::span<const std::byte> bytes, const std::string& name,
                                  const TensorFileLimits& limits);

}  // namespace faceprobe::io

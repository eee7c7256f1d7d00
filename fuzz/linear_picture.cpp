// OpenEXR and Radiance HDR pictures.

#include "faceprobe/core/error.h"
#include "io/photo_bytes.h"

#include <cstddef>
#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  try {
    faceprobe::io::Limits limits;
    limits.max_pixels = 1 << 20;
    limits.expansion_free_bytes = 8 << 20;
    faceprobe::io::linear_picture_from_bytes(bytes, "fuzz", limits);
  } catch (const faceprobe::Error&) {  // the only exception that may leave the room
  }
  return 0;
}

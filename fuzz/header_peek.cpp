// The header parsers of all picture formats, limits included.

#include "io/header_peek.h"
#include "faceprobe/core/error.h"

#include <cstddef>
#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  try {
    faceprobe::io::accept_header(bytes, "fuzz", {});
  } catch (const faceprobe::Error&) {  // the only exception that may leave the room
  }
  return 0;
}

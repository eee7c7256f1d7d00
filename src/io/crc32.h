#pragma once
// The checksum of PNG's chunks, CRC-32 (ISO/IEC 15948, 5.5), four bytes a step.
//
//   const std::uint32_t sum = crc32(std::as_bytes(std::span(text)));

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace faceprobe::io {

// Table t: what a byte does to the sum that stands t bytes before the end of its step.
inline constexpr auto kCrcTables = [] {
  std::array<std::array<std::uint32_t, 256>, 4> tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320U : 0U);
    tables[0][i] = value;
  }
  for (std::size_t t = 1; t < 4; ++t) {
    for (std::size_t i = 0; i < 256; ++i) tables[t][i] = (tables[t - 1][i] >> 8) ^ tables[0][tables[t - 1][i] & 255];
  }
  return tables;
}();

inline std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  std::size_t i = 0;
  const auto byte = [&](std::size_t k) { return std::to_integer<std::uint32_t>(bytes[i + k]); };
  for (; i + 4 <= bytes.size(); i += 4) {
    crc ^= byte(0) | (byte(1) << 8) | (byte(2) << 16) | (byte(3) << 24);
    crc = kCrcTables[3][crc & 255] ^ kCrcTables[2][(crc >> 8) & 255] ^ kCrcTables[1][(crc >> 16) & 255] ^
          kCrcTables[0][crc >> 24];
  }
  for (; i < bytes.size(); ++i) crc = (crc >> 8) ^ kCrcTables[0][(crc ^ byte(0)) & 255];
  return ~crc;
}

}  // namespace faceprobe::io

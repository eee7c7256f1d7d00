#include "io/plain_png.h"

#include "io/crc32.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

namespace faceprobe::io {
namespace {

constexpr std::size_t kLargestBlock = 65535;  // of a stored block
constexpr std::uint32_t kAdlerBase = 65521;

using Bytes = std::vector<std::byte>;

void put(Bytes& to, std::uint32_t value, int bytes) {  // most significant first
  for (int i = bytes - 1; i >= 0; --i) to.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xFFU));
}

std::uint32_t adler32(const Bytes& bytes) {
  std::uint32_t sum = 1;
  std::uint32_t sums = 0;
  for (const std::byte byte : bytes) {
    sum = (sum + std::to_integer<std::uint32_t>(byte)) % kAdlerBase;
    sums = (sums + sum) % kAdlerBase;
  }
  return (sums << 16U) | sum;
}

void put_chunk(Bytes& to, std::string_view type, const Bytes& data) {
  put(to, static_cast<std::uint32_t>(data.size()), 4);
  const std::size_t begin = to.size();  // the sum is over type and data
  for (const char letter : type) to.push_back(static_cast<std::byte>(letter));
  to.insert(to.end(), data.begin(), data.end());
  put(to, crc32(std::span(to).subspan(begin)), 4);
}

Bytes stored(const Bytes& data) {
  Bytes stream = {std::byte{0x78}, std::byte{0x01}};
  for (std::size_t at = 0; at < data.size(); at += kLargestBlock) {
    const auto size = static_cast<std::uint32_t>(std::min(kLargestBlock, data.size() - at));
    stream.push_back(static_cast<std::byte>(at + size == data.size() ? 1 : 0));  // the last block says so
    for (const std::uint32_t value : {size, ~size}) {
      stream.push_back(static_cast<std::byte>(value & 0xFFU));
      stream.push_back(static_cast<std::byte>((value >> 8U) & 0xFFU));
    }
    const auto begin = data.begin() + static_cast<std::ptrdiff_t>(at);
    stream.insert(stream.end(), begin, begin + size);
  }
  put(stream, adler32(data), 4);
  return stream;
}

}  // namespace

std::vector<std::byte> plain_png(const ByteImage& image) {
  const int channels = image.channels();
  if (image.empty() || (channels != 1 && channels != 3 && channels != 4)) {
    throw std::invalid_argument("A PNG has 1, 3 or 4 channels and at least one pixel.");
  }
  Bytes header;
  put(header, static_cast<std::uint32_t>(image.width()), 4);
  put(header, static_cast<std::uint32_t>(image.height()), 4);
  const std::uint32_t kind = channels == 1 ? 0 : channels == 3 ? 2 : 6;
  put(header, 8, 1);  // bits
  put(header, kind, 1);
  put(header, 0, 3);  // deflate, the usual filters, no interlacing
  Bytes rows;
  rows.reserve((image.row(0).size() + 1) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    rows.push_back(std::byte{0});  // not filtered
    for (const std::uint8_t value : image.row(y)) rows.push_back(static_cast<std::byte>(value));
  }
  Bytes png;
  for (const int byte : {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A}) {
    png.push_back(static_cast<std::byte>(byte));
  }
  put_chunk(png, "IHDR", header);
  put_chunk(png, "IDAT", stored(rows));
  put_chunk(png, "IEND", {});
  return png;
}

}  // namespace faceprobe::io

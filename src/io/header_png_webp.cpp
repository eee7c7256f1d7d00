// PNG (ISO/IEC 15948, 11.2.2 IHDR) and WebP (RFC 9649): both put the size at a fixed place near the front.

#include "io/crc32.h"
#include "io/header_peek.h"

namespace faceprobe::io {
namespace {

// What is wrong with the chunks that make the picture. libpng would find it too, but prints what it finds on stderr, and does
// not miss the end.
std::string png_damage(const ByteReader& r) {
  std::uint64_t at = 8;
  while (r.has(at, 12)) {
    const std::uint64_t size = r.u32(at);
    if (!r.has(at + 8, size + 4)) break;
    const bool critical = (r.u8(at + 4) & 0x20) == 0;  // upper-case first letter
    if (critical && crc32(r.bytes().subspan(at + 4, size + 4)) != r.u32(at + 8 + size)) {
      return "is damaged: a checksum in it is wrong. Copy or download it again";
    }
    if (r.matches(at + 4, "IEND")) return {};
    at += 12 + size;
  }
  return kCutShort;
}

// Key frame of a lossy picture: 3-byte frame tag, start code, two 14-bit sides (RFC 6386, 9.1).
void read_vp8(const ByteReader& r, std::uint64_t at, Header& header) {
  if (!r.matches(at + 3, "\x9d\x01\x2a")) throw HeaderProblem{"is a WebP without a key frame: it is damaged"};
  header.width = r.u16(at + 6) & 0x3FFF;
  header.height = r.u16(at + 8) & 0x3FFF;
  header.channels = 3;
  header.lossy = true;
}

// Signature byte, 14 bits width - 1, 14 bits height - 1, alpha bit (RFC 9649, 3.4).
void read_vp8l(const ByteReader& r, std::uint64_t at, Header& header) {
  if (r.u8(at) != 0x2F) throw HeaderProblem{"is a lossless WebP with a wrong signature: it is damaged"};
  const std::uint32_t packed = r.u32(at + 1);
  header.width = (packed & 0x3FFF) + 1;
  header.height = ((packed >> 14) & 0x3FFF) + 1;
  header.channels = ((packed >> 28) & 1) != 0 ? 4 : 3;
}

}  // namespace

Header peek_png(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kBig);
  if (!r.matches(12, "IHDR") || r.u32(8) != 13)
    throw HeaderProblem{"is a PNG whose first chunk is no IHDR: it is damaged"};
  Header header;
  header.format = "png";
  header.width = r.u32(16);
  header.height = r.u32(20);
  header.bits = r.u8(24);
  switch (r.u8(25)) {  // colour type; a palette is expanded, with its transparency
    case 0: header.channels = 1; break;
    case 2: header.channels = 3; break;
    case 3: header.channels = 4; break;
    case 4: header.channels = 2; break;
    case 6: header.channels = 4; break;
    default: throw HeaderProblem{"is a PNG of unknown colour type: it is damaged"};
  }
  if (header.bits != 1 && header.bits != 2 && header.bits != 4 && header.bits != 8 && header.bits != 16) {
    throw HeaderProblem{"is a PNG with " + std::to_string(header.bits) + " bits per channel: it is damaged"};
  }
  header.damage = png_damage(r);
  return header;
}

Header peek_webp(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kLittle);
  Header header;
  header.format = "webp";
  if (!r.has(8, r.u32(4))) header.damage = kCutShort;
  constexpr std::uint64_t kPayload = 20;  // after "RIFF" size "WEBP" and the first chunk's name and size
  if (r.matches(12, "VP8 ")) {
    read_vp8(r, kPayload, header);
  } else if (r.matches(12, "VP8L")) {
    read_vp8l(r, kPayload, header);
  } else if (r.matches(12, "VP8X")) {
    header.channels = (r.u8(kPayload) & 0x10) != 0 ? 4 : 3;
    header.width = std::int64_t{r.u24(kPayload + 4)} + 1;
    header.height = std::int64_t{r.u24(kPayload + 7)} + 1;
    header.lossy = true;  // not known without its frames; only loosens the test for grey
  } else {
    throw HeaderProblem{"is a WebP whose first chunk holds no picture: it is damaged"};
  }
  return header;
}

}  // namespace faceprobe::io

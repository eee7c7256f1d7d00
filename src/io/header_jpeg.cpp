// JPEG (ITU-T T.81 Annex B): walks every marker to the end of the image, because the scans that make a progressive file
// expensive lie anywhere in it, and a second frame header could contradict the first.

#include "io/header_peek.h"

#include <algorithm>

namespace faceprobe::io {
namespace {

constexpr std::uint8_t kEndOfImage = 0xD9;
constexpr std::uint8_t kStartOfScan = 0xDA;

bool is_standalone(std::uint8_t marker) { return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8); }
// SOF0 .. SOF15 without DHT (C4), JPG (C8) and DAC (CC), which share the range.
bool is_frame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

void read_frame(const ByteReader& r, std::uint64_t at, std::uint8_t marker, Header& header) {
  const int kind = marker - 0xC0;
  if (kind != 0 && kind != 1 && kind != 2 && kind != 9 && kind != 10) {
    throw HeaderProblem{"is a lossless or hierarchical JPEG, which is not supported; save it as a baseline JPEG"};
  }
  const int bits = r.u8(at + 4);
  if (bits != 8) {
    throw HeaderProblem{"is a JPEG with " + std::to_string(bits) +
                        " bits per channel; 8 are supported. Save it as PNG or TIFF"};
  }
  const int channels = r.u8(at + 9);
  if (channels == 4) {
    throw HeaderProblem{"is a CMYK JPEG (4 components); only grey and RGB photos are read. Convert it to RGB first"};
  }
  if (channels != 1 && channels != 3) {
    throw HeaderProblem{"is a JPEG with " + std::to_string(channels) + " components; 1 or 3 are supported"};
  }
  header.height = std::max<std::int64_t>(header.height, r.u16(at + 5));
  header.width = std::max<std::int64_t>(header.width, r.u16(at + 7));
  header.channels = std::max(header.channels, channels);
}

}  // namespace

Header peek_jpeg(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kBig);
  Header header;
  header.format = "jpeg";
  header.lossy = true;
  header.scans = 0;
  header.damage = kCutShort;
  // The same walk outside and inside entropy-coded data, as decoders do: skip to 0xFF, skip fill bytes, look at the code.
  // Stuffed zeros and restart markers inside the data carry no length.
  std::uint64_t at = 2;
  while ((at = r.find(at, 0xFF)) < r.size()) {
    while (at < r.size() && r.u8(at) == 0xFF) ++at;
    if (at >= r.size()) break;
    const std::uint8_t marker = r.u8(at);
    const std::uint64_t segment = at - 1;
    ++at;
    if (marker == 0 || is_standalone(marker)) continue;
    if (marker == kEndOfImage) {
      header.damage.clear();
      break;
    }
    if (!r.has(segment, 4)) break;
    const std::uint16_t length = r.u16(segment + 2);
    if (length < 2) throw HeaderProblem{"has a JPEG segment of impossible length: it is damaged"};
    if (is_frame(marker)) read_frame(r, segment, marker, header);
    if (marker == kStartOfScan) ++header.scans;
    at = segment + 2 + length;
  }
  if (header.channels == 0) throw HeaderProblem{"is a JPEG without a frame header: it is cut short or damaged"};
  return header;
}

}  // namespace faceprobe::io

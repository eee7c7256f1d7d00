// TIFF 6.0 and BigTIFF: the tags of the first directory. Later directories are never followed, so they cannot loop.

#include "io/header_peek.h"

#include <algorithm>

namespace faceprobe::io {
namespace {

constexpr std::uint64_t kMaxEntries = 1000;

struct Layout {
  bool big;               // BigTIFF: 64-bit counts and offsets
  std::uint64_t entry;    // bytes of a directory entry
  std::uint64_t inline_;  // bytes of a value that fit into the entry
};

std::uint64_t type_size(std::uint16_t type) {
  switch (type) {
    case 3: return 2;   // SHORT
    case 4: return 4;   // LONG
    case 16: return 8;  // LONG8
    default: return 0;  // not used by the tags below
  }
}

// Value number `index` of the entry at `at`, wherever it is stored.
std::uint64_t entry_value(const ByteReader& r, const Layout& layout, std::uint64_t at, std::uint64_t index = 0) {
  const std::uint64_t size = type_size(r.u16(at + 2));
  const std::uint64_t count = layout.big ? r.u64(at + 4) : r.u32(at + 4);
  if (size == 0 || index >= count) throw HeaderProblem{"is a TIFF with a tag of the wrong type: it is damaged"};
  const std::uint64_t field = at + (layout.big ? 12 : 8);
  std::uint64_t place = field + index * size;
  if (count > layout.inline_ / size) {
    const std::uint64_t offset = layout.big ? r.u64(field) : r.u32(field);
    if (!r.has(offset, (index + 1) * size))
      throw HeaderProblem{"is a TIFF with a tag outside the file: it is cut short"};
    place = offset + index * size;
  }
  return size == 2 ? r.u16(place) : size == 4 ? r.u32(place) : r.u64(place);
}

void refuse_colour(std::uint64_t photometric) {
  switch (photometric) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 6: return;  // white- and black-is-zero, RGB, palette, YCbCr
    case 5: throw HeaderProblem{"is a CMYK TIFF; only grey and RGB photos are read. Convert it to RGB first"};
    case 8:
    case 9:
    case 10: throw HeaderProblem{"is a Lab TIFF; only grey and RGB photos are read. Convert it to RGB first"};
    case 32803:
    case 34892: throw HeaderProblem{"holds raw sensor data, which is not read. Develop it to a 16-bit TIFF first"};
    default:
      throw HeaderProblem{"is a TIFF of an unsupported colour kind (" + std::to_string(photometric) +
                          "); only grey and RGB photos are read"};
  }
}

std::int64_t clamp_side(std::uint64_t value) {  // keeps products of two sides far from overflow
  return static_cast<std::int64_t>(std::min<std::uint64_t>(value, 1ULL << 32));
}

}  // namespace

Header peek_tiff(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteReader(bytes, ByteOrder::kBig).matches(0, "II") ? ByteOrder::kLittle : ByteOrder::kBig);
  const bool big = r.u16(2) == 43;
  const Layout layout = big ? Layout{true, 20, 8} : Layout{false, 12, 4};
  const std::uint64_t directory = big ? r.u64(8) : r.u32(4);
  if (!r.has(directory, big ? 8 : 2))
    throw HeaderProblem{"is a TIFF whose directory lies outside the file: it is cut short"};
  const std::uint64_t entries = big ? r.u64(directory) : r.u16(directory);
  if (entries == 0 || entries > kMaxEntries) {
    throw HeaderProblem{"is a TIFF with " + std::to_string(entries) + " tags, at most 1000 are allowed: it is damaged"};
  }
  Header header;
  header.format = "tiff";
  header.channels = 1;  // the defaults of TIFF 6.0
  header.bits = 1;
  bool palette = false;
  const std::uint64_t first = directory + (big ? 8 : 2);
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t at = first + i * layout.entry;
    switch (r.u16(at)) {
      case 256: header.width = clamp_side(entry_value(r, layout, at)); break;
      case 257: header.height = clamp_side(entry_value(r, layout, at)); break;
      case 258: header.bits = static_cast<int>(std::min<std::uint64_t>(entry_value(r, layout, at), 64)); break;
      case 259: header.lossy = header.lossy || entry_value(r, layout, at) == 7; break;  // JPEG inside
      case 262: {
        const std::uint64_t photometric = entry_value(r, layout, at);
        refuse_colour(photometric);
        palette = photometric == 3;
        break;
      }
      case 277: header.channels = static_cast<int>(std::min<std::uint64_t>(entry_value(r, layout, at), 1 << 16)); break;
      case 322: header.tile_width = clamp_side(entry_value(r, layout, at)); break;
      case 323: header.tile_height = clamp_side(entry_value(r, layout, at)); break;
      case 339: header.is_float = entry_value(r, layout, at) == 3; break;
      case 50706:
        throw HeaderProblem{"holds raw sensor data (DNG), which is not read. Develop it to a 16-bit TIFF first"};
      default: break;
    }
  }
  if (header.channels < 1) throw HeaderProblem{"is a TIFF without channels: it is damaged"};
  if (palette) {  // expanded to 8-bit RGB by the decoder
    header.channels = 3;
    header.bits = 8;
  }
  return header;
}

}  // namespace faceprobe::io

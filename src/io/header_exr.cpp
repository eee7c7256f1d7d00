// OpenEXR ("OpenEXR File Layout", openexr.com): walks the attributes of every part's header.

#include "io/header_peek.h"

#include <algorithm>

namespace faceprobe::io {
namespace {

constexpr std::uint32_t kTiled = 0x200;
constexpr std::uint32_t kLongNames = 0x400;
constexpr std::uint32_t kDeep = 0x800;
constexpr std::uint32_t kMultiPart = 0x1000;
constexpr int kMaxParts = 64;
constexpr int kMaxAttributes = 2000;

struct Part {
  std::int64_t width = 0, height = 0;
  std::int64_t tile_width = 0, tile_height = 0;
  int channels = 0;
  int bits = 0;
  int compression = 0;
};

void read_channels(const ByteReader& r, std::uint64_t at, std::uint64_t end, std::uint64_t max_name, Part& part) {
  while (at < end && r.u8(at) != 0) {
    at += r.text_until(at, '\0', max_name).size() + 1;
    const std::uint32_t type = r.u32(at);
    if (type > 2) throw HeaderProblem{"is an EXR with a channel of unknown type: it is damaged"};
    part.bits = std::max(part.bits, type == 1 ? 16 : 32);
    ++part.channels;
    at += 16;  // type, linear flag and padding, two sampling rates
  }
}

// Rows that share one chunk, by compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
std::int64_t rows_per_chunk(int compression) {
  constexpr std::int64_t kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  if (compression < 0 || compression > 9)
    throw HeaderProblem{"is an EXR of unknown compression: it is damaged or too new"};
  return kRows[compression];
}

// Readers allocate the table of chunk offsets before they look at the data. The table lies in the file, 8 bytes a chunk, so
// a header that needs a longer table than the file is a lie.
void check_chunk_table(const Part& part, std::uint64_t file_bytes) {
  double chunks = 0;
  if (part.tile_width > 0) {
    chunks = static_cast<double>((part.width + part.tile_width - 1) / part.tile_width) *
             static_cast<double>((part.height + part.tile_height - 1) / part.tile_height);
  } else {
    const std::int64_t rows = rows_per_chunk(part.compression);
    chunks = static_cast<double>((part.height + rows - 1) / rows);
  }
  if (chunks * 8 > static_cast<double>(file_bytes)) {
    throw HeaderProblem{"is an EXR that claims " + std::to_string(part.width) + " x " + std::to_string(part.height) +
                        " px in " + std::to_string(file_bytes) + " bytes, fewer than its own table of contents needs"};
  }
}

// Reads attributes from `at` to the end of the part's header; returns the offset behind it.
std::uint64_t read_part(const ByteReader& r, std::uint64_t at, std::uint64_t max_name, Part& part) {
  for (int i = 0; i < kMaxAttributes; ++i) {
    if (r.u8(at) == 0) return at + 1;
    const std::string_view name = r.text_until(at, '\0', max_name);
    at += name.size() + 1;
    at += r.text_until(at, '\0', max_name).size() + 1;
    const std::int32_t size = r.i32(at);
    at += 4;
    if (size < 0 || !r.has(at, static_cast<std::uint64_t>(size))) {
      throw HeaderProblem{"is an EXR with an attribute outside the file: it is cut short or damaged"};
    }
    if (name == "dataWindow") {
      part.width = std::int64_t{r.i32(at + 8)} - r.i32(at) + 1;
      part.height = std::int64_t{r.i32(at + 12)} - r.i32(at + 4) + 1;
    } else if (name == "channels") {
      read_channels(r, at, at + static_cast<std::uint64_t>(size), max_name, part);
    } else if (name == "compression") {
      part.compression = r.u8(at);
    } else if (name == "tiles") {
      part.tile_width = r.u32(at);
      part.tile_height = r.u32(at + 4);
      if (part.tile_width <= 0 || part.tile_height <= 0)
        throw HeaderProblem{"is an EXR with empty tiles: it is damaged"};
    }
    at += static_cast<std::uint64_t>(size);
  }
  throw HeaderProblem{"is an EXR with more than 2000 attributes: it is damaged"};
}

}  // namespace

Header peek_exr(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kLittle);
  const std::uint32_t version = r.u32(4);
  if ((version & kDeep) != 0) throw HeaderProblem{"is a deep EXR; only flat pictures are read. Flatten it first"};
  const std::uint64_t max_name = (version & kLongNames) != 0 ? 255 : 31;
  Header header;
  header.format = "exr";
  header.is_float = true;
  std::uint64_t at = 8;
  for (int count = 0; count < kMaxParts; ++count) {
    Part part;
    at = read_part(r, at, max_name, part);
    if (part.width <= 0 || part.height <= 0 || part.channels == 0) {
      throw HeaderProblem{"is an EXR without a picture: it is damaged"};
    }
    // `tiles` may linger in a scan-line file; only a part that is tiled allocates them.
    if ((version & (kTiled | kMultiPart)) == 0) part.tile_width = part.tile_height = 0;
    check_chunk_table(part, r.size());
    if (count == 0) {  // the part that is decoded
      header.width = part.width;
      header.height = part.height;
      header.bits = part.bits;
    }
    header.channels = std::max(header.channels, part.channels);
    header.tile_width = std::max(header.tile_width, part.tile_width);
    header.tile_height = std::max(header.tile_height, part.tile_height);
    if ((version & kMultiPart) == 0 || r.u8(at) == 0) return header;
  }
  throw HeaderProblem{"is an EXR with more than 64 parts, which is not supported"};
}

}  // namespace faceprobe::io

// HEIF (ISO/IEC 23008-12): the boxes meta / iprp / ipco / ispe. Which item is shown is left to the decoder; the largest `ispe`
// bounds it, because tiles and thumbnails are never larger than the picture.

#include "io/header_peek.h"

#include <algorithm>

namespace faceprobe::io {
namespace {

constexpr int kMaxBoxes = 4000;

struct Box {
  std::uint64_t payload;
  std::uint64_t end;
  std::uint32_t type;
};

constexpr std::uint32_t four_cc(const char (&text)[5]) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(text[i]);
  return value;
}

// Calls visit(box) for each box in [at, end). `budget` counts boxes over the whole file.
template <class Visit>
void for_each_box(const ByteReader& r, std::uint64_t at, std::uint64_t end, int& budget, const Visit& visit) {
  while (at < end && end - at >= 8) {
    if (--budget < 0) throw HeaderProblem{"is a HEIF with more than 4000 boxes: it is damaged"};
    std::uint64_t size = r.u32(at);
    std::uint64_t head = 8;
    if (size == 1) {
      size = r.u64(at + 8);
      head = 16;
    } else if (size == 0) {
      size = end - at;  // to the end of the enclosing box
    }
    if (size < head || size > end - at) throw HeaderProblem{"is a HEIF with a box outside the file: it is cut short"};
    visit(Box{at + head, at + size, r.u32(at + 4)});
    at += size;
  }
}

void read_properties(const ByteReader& r, const Box& container, int& budget, Header& header) {
  for_each_box(r, container.payload, container.end, budget, [&](const Box& box) {
    if (box.type == four_cc("ispe")) {
      const std::int64_t width = r.u32(box.payload + 4);
      const std::int64_t height = r.u32(box.payload + 8);
      // Sides apart: a 1 x N and an N x 1 item must not hide behind one another.
      header.width = std::max(header.width, width);
      header.height = std::max(header.height, height);
    } else if (box.type == four_cc("pixi")) {
      if (r.u8(box.payload + 4) > 0) header.bits = std::max<int>(header.bits, r.u8(box.payload + 5));
    }
  });
}

bool is_still_picture_brand(const ByteReader& r, const Box& ftyp) {
  for (std::uint64_t at = ftyp.payload; at + 4 <= ftyp.end;
       at += at == ftyp.payload ? 8 : 4) {  // skips the minor version
    for (const char* brand : {"heic", "heix", "heim", "heis", "mif1", "avif"}) {
      if (r.matches(at, brand)) return true;
    }
  }
  return false;
}

}  // namespace

Header peek_heif(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kBig);
  Header header;
  header.format = "heif";
  header.channels = 4;  // alpha may be an auxiliary item
  header.lossy = true;
  int budget = kMaxBoxes;
  for_each_box(r, 0, r.size(), budget, [&](const Box& top) {
    if (top.type == four_cc("ftyp") && !is_still_picture_brand(r, top)) {
      throw HeaderProblem{"is a video or another ISO media file, not a picture"};
    }
    if (top.type != four_cc("meta")) return;
    for_each_box(r, top.payload + 4, top.end, budget, [&](const Box& inner) {  // a full box: version and flags first
      if (inner.type != four_cc("iprp")) return;
      for_each_box(r, inner.payload, inner.end, budget, [&](const Box& property) {
        if (property.type == four_cc("ipco")) read_properties(r, property, budget, header);
      });
    });
  });
  if (header.width == 0) throw HeaderProblem{"is a HEIF that does not tell its size: it is cut short or damaged"};
  return header;
}

}  // namespace faceprobe::io

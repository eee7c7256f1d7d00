#pragma once
// What a picture file says about itself, read by our own parsers before any decoder is called: OpenImageIO 2.4 allocates what
// a header claims (12 GB for a 522-byte progressive JPEG), so the claim has to be judged first. The content decides the
// format, never the extension.

#include "faceprobe/io/limits.h"
#include "io/byte_reader.h"

#include <cstdint>
#include <span>
#include <string>

namespace faceprobe::io {

inline constexpr char kCutShort[] = "is cut short: its end is missing. Copy or download it again";

struct Header {
  std::string format;  // as in Photo::format
  std::int64_t width = 0;
  std::int64_t height = 0;
  int channels = 0;
  int bits = 8;  // per channel
  bool is_float = false;
  bool lossy = false;
  int scans = 1;  // passes a decoder makes over the whole picture
  // Largest tile that a decoder must hold; 0 when the picture is not tiled.
  std::int64_t tile_width = 0;
  std::int64_t tile_height = 0;
  // Why the file cannot be whole, seen from its framing ("is cut short ..."); empty when nothing is wrong. Kept apart from the
  // problems that peek_header throws, so that a header which asks for too much is refused for that.
  std::string damage;
};

// Throws Error(kInput), naming the file, when the bytes are no picture of a kind we read.
Header peek_header(std::span<const std::byte> bytes, const std::string& name);
// Throws Error(kInput) that names the limit and the value found.
void check_limits(const Header& header, std::int64_t file_bytes, const std::string& name, const Limits& limits);
// Both, and refuses files with `damage`.
Header accept_header(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

// One per format; each throws HeaderProblem.
Header peek_jpeg(std::span<const std::byte> bytes);
Header peek_png(std::span<const std::byte> bytes);
Header peek_webp(std::span<const std::byte> bytes);
Header peek_tiff(std::span<const std::byte> bytes);
Header peek_exr(std::span<const std::byte> bytes);
Header peek_radiance(std::span<const std::byte> bytes);
Header peek_heif(std::span<const std::byte> bytes);

}  // namespace faceprobe::io

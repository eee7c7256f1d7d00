#include "io/header_peek.h"

#include "faceprobe/core/error.h"

#include <cmath>

namespace faceprobe::io {
namespace {

bool is_tiff(const ByteReader& r) {
  using namespace std::string_view_literals;
  return r.matches(0, "II\x2a\0"sv) || r.matches(0, "MM\0\x2a"sv) || r.matches(0, "II\x2b\0"sv) ||
         r.matches(0, "MM\0\x2b"sv);
}

Header peek(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kBig);
  if (r.matches(0, "\xff\xd8\xff")) return peek_jpeg(bytes);
  if (r.matches(0, "\x89PNG\r\n\x1a\n")) return peek_png(bytes);
  if (r.matches(0, "RIFF") && r.matches(8, "WEBP")) return peek_webp(bytes);
  if (is_tiff(r)) return peek_tiff(bytes);
  if (r.matches(0, "\x76\x2f\x31\x01")) return peek_exr(bytes);
  if (r.matches(0, "#?RADIANCE") || r.matches(0, "#?RGBE")) return peek_radiance(bytes);
  if (r.matches(4, "ftyp")) return peek_heif(bytes);
  throw HeaderProblem{"is not a picture that can be read; JPEG, PNG, TIFF, WebP, HEIC, OpenEXR and Radiance HDR can"};
}

std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

Header peek_header(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.empty()) throw Error(ExitCode::kInput, name + " is empty.");
  try {
    Header header = peek(bytes);
    if (header.width <= 0 || header.height <= 0) {
      throw HeaderProblem{"claims " + size_text(header.width, header.height) + " px: it holds no picture or is damaged"};
    }
    return header;
  } catch (const HeaderProblem& problem) {
    throw Error(ExitCode::kInput, name + " " + problem.what + ".");
  }
}

void check_limits(const Header& header, std::int64_t file_bytes, const std::string& name, const Limits& limits) {
  const std::string claim =
      name + " claims " + size_text(header.width, header.height) + " px in " + std::to_string(file_bytes) + " bytes; ";
  const auto refuse = [&](const std::string& what) { throw Error(ExitCode::kInput, claim + what); };
  // Double precision: the product of two hostile 64-bit numbers must not wrap.
  const double pixels = static_cast<double>(header.width) * static_cast<double>(header.height);
  if (pixels > static_cast<double>(limits.max_pixels)) {
    refuse("at most " + std::to_string(limits.max_pixels) +
           " px are allowed. Make it smaller, or raise the limit with --max-pixels.");
  }
  if (header.width > limits.max_side_px || header.height > limits.max_side_px) {
    refuse("at most " + std::to_string(limits.max_side_px) + " px on a side are allowed. Make it smaller.");
  }
  if (static_cast<double>(header.tile_width) * static_cast<double>(header.tile_height) >
      std::max(static_cast<double>(limits.max_pixels), pixels)) {
    refuse("and tiles of " + size_text(header.tile_width, header.tile_height) +
           " px. Its header is damaged or malicious.");
  }
  if (header.channels > limits.max_channels) {
    throw Error(ExitCode::kInput, name + " has " + std::to_string(header.channels) + " channels; at most " +
                                      std::to_string(limits.max_channels) +
                                      " are allowed. Keep only its colour channels.");
  }
  if (header.scans > limits.max_jpeg_scans) {
    throw Error(ExitCode::kInput, name + " has " + std::to_string(header.scans) + " JPEG scans; at most " +
                                      std::to_string(limits.max_jpeg_scans) +
                                      " are allowed. Save it anew as a baseline JPEG.");
  }
  const double declared = pixels * header.channels * std::max(header.bits, 8) / 8.0;
  if (declared > static_cast<double>(limits.expansion_free_bytes) &&
      declared > limits.max_expansion * static_cast<double>(file_bytes)) {
    refuse("that is " + std::to_string(std::llround(declared / static_cast<double>(file_bytes))) +
           " times its size, at most " + std::to_string(std::llround(limits.max_expansion)) +
           " times is allowed. Its header is damaged or malicious.");
  }
}

Header accept_header(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
  if (const std::string problem = limits.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  Header header = peek_header(bytes, name);
  check_limits(header, static_cast<std::int64_t>(bytes.size()), name, limits);
  if (!header.damage.empty()) throw Error(ExitCode::kInput, name + " " + header.damage + ".");
  return header;
}

}  // namespace faceprobe::io

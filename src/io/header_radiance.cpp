// Radiance RGBE ("File Formats for the Radiance Picture", Ward): text lines up to an empty one, then the resolution.

#include "io/header_peek.h"

#include <charconv>

namespace faceprobe::io {
namespace {

constexpr int kMaxLines = 1000;
constexpr std::uint64_t kMaxLine = 16384;

// Reads "<label> <number>" and moves `text` behind it.
bool take(std::string_view& text, std::string_view label, std::int64_t& value) {
  if (text.substr(0, label.size()) != label) return false;
  text.remove_prefix(label.size());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

Header peek_radiance(std::span<const std::byte> bytes) {
  const ByteReader r(bytes, ByteOrder::kBig);
  Header header;
  header.format = "hdr";
  header.channels = 3;
  header.bits = 32;
  header.is_float = true;
  std::uint64_t at = 0;
  for (int line = 0; line < kMaxLines; ++line) {
    std::string_view text = r.text_until(at, '\n', kMaxLine);
    at += text.size() + 1;
    if (text.substr(0, 7) == "FORMAT=" && text.find("xyze") != std::string_view::npos) {
      throw HeaderProblem{"is a Radiance picture in XYZE; only RGBE is read. Convert it with ra_xyze -r"};
    }
    if (!text.empty() && text != "\r") continue;
    std::string_view resolution = r.text_until(at, '\n', kMaxLine);
    if (!take(resolution, "-Y ", header.height) || !take(resolution, " +X ", header.width)) {
      throw HeaderProblem{
          "is a Radiance picture whose resolution line is not '-Y height +X width': turn it upright first"};
    }
    return header;
  }
  throw HeaderProblem{"is a Radiance picture whose header does not end: it is damaged"};
}

}  // namespace faceprobe::io

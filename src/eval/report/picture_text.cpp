#include "eval/report/picture_text.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/limits.h"
#include "io/decoder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr char kPngStart[] = "data:image/png;base64,";
constexpr char kPlace[] = "A picture of the section";

[[noreturn]] void not_base64() {
  throw Error(ExitCode::kInput, std::string(kPlace) + " is no PNG in base64. Measure it again.");
}

int digit_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// RFC 4648, from `begin` on.
std::vector<std::byte> base64_bytes(const std::string& text, std::size_t begin) {
  std::size_t end = text.size();
  if ((end - begin) % 4 != 0) not_base64();
  for (int i = 0; i < 2 && end > begin && text[end - 1] == '='; ++i) --end;
  std::vector<std::byte> out;
  out.reserve((end - begin) / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const int digit = digit_of(text[i]);
    if (digit < 0) not_base64();
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(static_cast<std::byte>((bits >> static_cast<unsigned>(count)) & 0xFFU));
  }
  return out;
}

}  // namespace

ByteImage picture_of_data_uri(const std::string& uri) {
  if (!uri.starts_with(kPngStart)) not_base64();
  const std::vector<std::byte> bytes = base64_bytes(uri, sizeof(kPngStart) - 1);
  const io::Header header = io::accept_header(bytes, kPlace, io::Limits{});
  if (header.format != "png") not_base64();
  io::Decoder decoder(bytes, header, kPlace);
  ByteImage picture(decoder.width(), decoder.height(), decoder.channels());
  decoder.read_rows(0, decoder.height(), picture.data());
  return picture;
}

}  // namespace faceprobe::eval

#include "io/crc32.h"

#include <gtest/gtest.h>

#include <string>

namespace faceprobe::io {
namespace {

std::uint32_t sum_of(const std::string& text) { return crc32(std::as_bytes(std::span(text))); }

// Published sums: of no bytes, the check value of the catalogue of CRCs, and the one that ends every PNG.
TEST(Crc32, OfKnownTexts) {
  EXPECT_EQ(sum_of(""), 0U);
  EXPECT_EQ(sum_of("123456789"), 0xCBF43926U);
  EXPECT_EQ(sum_of("IEND"), 0xAE426082U);
}

// One changed bit always shows, wherever it stands in a step of four bytes.
TEST(Crc32, SeesOneBit) {
  const std::string text = "a chunk of a PNG";
  for (std::size_t length = 1; length <= text.size(); ++length) {
    std::string other = text.substr(0, length);
    other.back() = static_cast<char>(other.back() ^ 4);
    EXPECT_NE(sum_of(other), sum_of(text.substr(0, length))) << length;
  }
}

}  // namespace
}  // namespace faceprobe::io

#pragma once
// Reads numbers from untrusted bytes: every access is checked, nothing is allocated, offsets cannot wrap.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace faceprobe::io {

// What is wrong with a header, as the rest of a sentence that begins with the file's name.
struct HeaderProblem {
  std::string what;
};

enum class ByteOrder { kBig, kLittle };

class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

  std::uint64_t size() const { return bytes_.size(); }
  bool has(std::uint64_t at, std::uint64_t count) const { return at <= size() && count <= size() - at; }

  std::uint8_t u8(std::uint64_t at) const { return static_cast<std::uint8_t>(number(at, 1)); }
  std::uint16_t u16(std::uint64_t at) const { return static_cast<std::uint16_t>(number(at, 2)); }
  std::uint32_t u24(std::uint64_t at) const { return static_cast<std::uint32_t>(number(at, 3)); }
  std::uint32_t u32(std::uint64_t at) const { return static_cast<std::uint32_t>(number(at, 4)); }
  std::int32_t i32(std::uint64_t at) const { return static_cast<std::int32_t>(u32(at)); }
  std::uint64_t u64(std::uint64_t at) const { return number(at, 8); }

  // The text matches the bytes at `at`; false also when the bytes end before.
  bool matches(std::uint64_t at, std::string_view text) const {
    return has(at, text.size()) && std::memcmp(bytes_.data() + at, text.data(), text.size()) == 0;
  }
  // Text up to, not including, a terminator that must follow within max_length bytes.
  std::string_view text_until(std::uint64_t at, char terminator, std::uint64_t max_length) const {
    const std::uint64_t left = at <= size() ? size() - at : 0;
    const std::uint64_t span = left < max_length + 1 ? left : max_length + 1;
    const auto* begin = reinterpret_cast<const char*>(bytes_.data()) + (at <= size() ? at : 0);
    const void* end = span > 0 ? std::memchr(begin, terminator, span) : nullptr;
    if (end == nullptr) throw HeaderProblem{"ends inside its header or has a damaged one"};
    return {begin, static_cast<std::size_t>(static_cast<const char*>(end) - begin)};
  }
  // Offset of the next byte of this value from `at` on, or size().
  std::uint64_t find(std::uint64_t at, std::uint8_t value) const {
    if (at >= size()) return size();
    const void* hit = std::memchr(bytes_.data() + at, value, bytes_.size() - at);
    return hit == nullptr ? size() : static_cast<std::uint64_t>(static_cast<const std::byte*>(hit) - bytes_.data());
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::uint64_t number(std::uint64_t at, unsigned count) const {
    if (!has(at, count)) throw HeaderProblem{"ends inside its header: the file is cut short"};
    std::uint64_t value = 0;
    for (unsigned i = 0; i < count; ++i) {
      const unsigned k = order_ == ByteOrder::kBig ? i : count - 1 - i;
      value = (value << 8) | std::to_integer<std::uint64_t>(bytes_[at + k]);
    }
    return value;
  }

  std::span<const std::byte> bytes_;
  ByteOrder order_;
};

}  // namespace faceprobe::io

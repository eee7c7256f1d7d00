#include "fixtures.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

namespace faceprobe::io::testing {

namespace fs = std::filesystem;

Bytes slurp(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return to_bytes(text);
}

void spit(const fs::path& path, std::span<const std::byte> bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  ASSERT_TRUE(file.good()) << path;
}

Bytes to_bytes(std::string_view text) {
  Bytes bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

void put_big(Bytes& bytes, std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i) bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 255));
}

void put_little(Bytes& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 255));
}

void put_text(Bytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

void write_with(const std::string& format, const fs::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                const void* values) {
  const std::unique_ptr<OIIO::ImageOutput> writer = OIIO::ImageOutput::create(format);
  ASSERT_TRUE(writer) << OIIO::geterror();
  ASSERT_TRUE(writer->open(path.string(), spec)) << writer->geterror();
  ASSERT_TRUE(writer->write_image(type, values)) << writer->geterror();
  ASSERT_TRUE(writer->close()) << writer->geterror();
}

void write_bytes(const std::string& format, const fs::path& path, const ByteImage& image,
                 const OIIO::ParamValueList& attributes) {
  OIIO::ImageSpec spec(image.width(), image.height(), image.channels(), OIIO::TypeDesc::UINT8);
  spec.extra_attribs = attributes;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Full chroma at high quality: what is left of JPEG's error is one or two codes in flat areas.
  if (format == "jpeg") {
    spec.attribute("Compression", "jpeg:98");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (format == "webp") spec.attribute("Compression", "lossless");
  write_with(format, path, spec, OIIO::TypeDesc::UINT8, image.data());
}

ByteImage quadrants() {
  constexpr std::uint8_t kColours[4][3] = {{200, 40, 40}, {40, 180, 40}, {40, 40, 160}, {150, 150, 30}};
  ByteImage image(32, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int c = 0; c < 3; ++c) image(x, y, c) = kColours[(y / 24) * 2 + x / 16][c];
    }
  }
  return image;
}

ByteImage gradient(int width, int height, int channels) {
  ByteImage image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c)
        image(x, y, c) = static_cast<std::uint8_t>((x * (c + 1) + 3 * y + 40 * c) % 256);
    }
  }
  return image;
}

}  // namespace faceprobe::io::testing
